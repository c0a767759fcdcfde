// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Scalar equations of several points at once, each kept inside its bracket.

#include "furrow/simd/lanes.h"

namespace furrow {
inline namespace FURROW_ISA {

/// never met: bisection alone needs 60 for any bracket of doubles used here
constexpr int max_root_iterations = 200;

struct ValueAndSlope {
  Lanes value, slope;
};

/// x in [low, high] with f(x) = 0, where f > 0 at low and f <= 0 at high (a jump of sign counts as
/// a root). Newton's method; a step that leaves the bracket or does not halve the last one is
/// replaced by bisection, so it ends for every f.
/// @param tolerance   on x
/// @param active      lanes to solve; the others return x as given
/// @param iterations  += evaluations of f, lane by lane
template <class Function>
FURROW_INLINE Lanes decreasing_root(Function&& f, Lanes x, Lanes low, Lanes high,
                                    const Lanes& tolerance, Mask active, Lanes& iterations) {
  Lanes last = high - low;
  for (int i = 0; i < max_root_iterations && any(active); ++i) {
    const ValueAndSlope at = f(x);
    where(active, iterations) += 1.0;
    const Mask left = at.value > Lanes(0.0);
    where(active && left, low) = x;
    where(active && !left, high) = x;
    Lanes step = -at.value / at.slope;
    const Lanes newton = x + step;
    const Mask trusted = at.slope < Lanes(0.0) && finite(at.slope) && newton >= low &&
                         newton <= high && abs(step) <= Lanes(0.5) * abs(last);
    step = select(trusted, step, Lanes(0.5) * (low + high) - x);
    where(active, x) = x + step;
    where(active, last) = step;
    active =
        active && !(abs(step) <= tolerance || high - low <= tolerance || at.value == Lanes(0.0));
  }
  return x;
}

}  // namespace FURROW_ISA
}  // namespace furrow
