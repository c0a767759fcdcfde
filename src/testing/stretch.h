// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "furrow/material/material.h"

namespace furrow {

/// Displacement gradient of a step with Delta F = exp(strain), strain symmetric.
inline Matrix3 stretch(const Vector6& strain) {
  const Matrix3 e = to_matrix(strain);
  Matrix3 term = e;
  Matrix3 sum = e;
  for (int k = 2; k < 60 && term.norm() > 1e-18 * sum.norm(); ++k) {
    term = term * e / k;
    sum += term;
  }
  return sum;
}

}  // namespace furrow
