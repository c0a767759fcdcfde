// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Smooth change from 0 to 1 for loads and speeds.

#include <algorithm>

namespace furrow {

/// S(u) = u^3 (10 - 15 u + 6 u^2): 0 for u <= 0, 1 for u >= 1, with continuous first and second
/// derivatives.
inline double smooth_step(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * u * (10.0 - u * (15.0 - 6.0 * u));
}

}  // namespace furrow
