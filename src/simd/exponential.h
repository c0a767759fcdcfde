// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// exp and log of several numbers at once.

#include <cstdint>

#include "simd/lanes.h"

namespace furrow {
inline namespace FURROW_ISA {

/// exp(a) to about one unit in the last place: a = n ln 2 + r with |r| <= ln(2)/2 and the Taylor
/// series of exp(r) to r^13 / 13!, whose rest is below 5e-18. Underflows to 0, overflows to
/// infinity, keeps not-a-number.
FURROW_INLINE Lanes exponential(const Lanes& a) {
  using Integers = stdx::rebind_simd_t<std::int64_t, Lanes>;
  // 1.5 * 2^52: adding it rounds to the nearest integer, held in the last bits
  constexpr double shift = 6755399441055744.0;
  const Lanes bounded = max(min(a, 709.7), -708.3);
  const Lanes shifted = bounded * Lanes(1.4426950408889634) + Lanes(shift);
  const Lanes n = shifted - Lanes(shift);
  const Lanes r =
      (bounded - n * Lanes(0.693147180369123816490)) - n * Lanes(1.90821492927058770002e-10);
  constexpr double inverse_factorial[14] = {1.0,
                                            1.0,
                                            1.0 / 2,
                                            1.0 / 6,
                                            1.0 / 24,
                                            1.0 / 120,
                                            1.0 / 720,
                                            1.0 / 5040,
                                            1.0 / 40320,
                                            1.0 / 362880,
                                            1.0 / 3628800,
                                            1.0 / 39916800,
                                            1.0 / 479001600,
                                            1.0 / 6227020800.0};
  // in pairs and pairs of these (Estrin), which wait for one another less than Horner's nesting
  const Lanes r2 = r * r, r4 = r2 * r2, r8 = r4 * r4;
  const auto pair = [&](int k) __attribute__((always_inline)) {
    return Lanes(inverse_factorial[k + 1]) * r + Lanes(inverse_factorial[k]);
  };
  const auto four = [&](int k) __attribute__((always_inline)) {
    return pair(k + 2) * r2 + pair(k);
  };
  const Lanes sum = (pair(12) * r4 + four(8)) * r8 + (four(4) * r4 + four(0));
  Integers bits;
  static_assert(sizeof(Integers) == sizeof(Lanes));
  __builtin_memcpy(static_cast<void*>(&bits), &shifted, sizeof bits);
  bits = (bits << 52) + Integers(std::int64_t{0x3FF0000000000000});  // 2^n
  Lanes power;
  __builtin_memcpy(static_cast<void*>(&power), &bits, sizeof power);
  Lanes result = sum * power;
  result = select(a < Lanes(-708.3), 0.0, result);
  result = select(a > Lanes(709.7), Lanes(__builtin_inf()), result);
  return select(a == a, result, a);
}

inline Lanes logarithm(const Lanes& a) {
  return per_lane(a, [](double x) { return __builtin_log(x); });
}

}  // namespace FURROW_ISA
}  // namespace furrow
