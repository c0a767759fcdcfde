// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// x^(-1/3) of several numbers at once, without a division in the iteration.

#include "furrow/simd/lanes.h"

namespace furrow {
inline namespace FURROW_ISA {

/// Inverse cube root to round-off for x > 0; of no meaning elsewhere. Newton's z <- z (4 - x z^3)/3
/// grows monotonically to the root from any start below it; near 1 a series is the start.
FURROW_INLINE Lanes inverse_cube_root(const Lanes& x) {
  const Lanes e = x - Lanes(1.0);
  const Lanes series = Lanes(1.0) - e * (Lanes(1.0 / 3.0) - e * Lanes(2.0 / 9.0));
  const Lanes below = min(Lanes(1.0), Lanes(1.0) / x);
  Lanes z = select(abs(e) < Lanes(0.5), series, below);
  for (int pass = 0; pass < 60; ++pass) {
    const Lanes error = Lanes(1.0) - x * z * z * z;
    z += z * error * Lanes(1.0 / 3.0);
    if (!any(abs(error) > Lanes(1e-8))) break;  // squared by this pass
  }
  return z;
}

}  // namespace FURROW_ISA
}  // namespace furrow
