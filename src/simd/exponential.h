// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// exp, exp - 1 and log of several numbers at once.

#include <cstdint>

#include "furrow/simd/lanes.h"

namespace furrow {
inline namespace FURROW_ISA {

/// a = n ln 2 + r with |r| <= ln(2)/2; a beyond -708.3 and 709.7 counts as these
struct ReducedExponent {
  Lanes r;
  Lanes power;  ///< 2^n
};
FURROW_INLINE ReducedExponent reduced_exponent(const Lanes& a) {
  // 1.5 * 2^52: adding it rounds to the nearest integer, held in the last bits
  constexpr double shift = 6755399441055744.0;
  const Lanes bounded = max(min(a, 709.7), -708.3);
  const Lanes shifted = bounded * Lanes(1.4426950408889634) + Lanes(shift);
  const Lanes n = shifted - Lanes(shift);
  const Lanes r =
      (bounded - n * Lanes(0.693147180369123816490)) - n * Lanes(1.90821492927058770002e-10);
  const Integers bits =
      (reinterpret_cast<Integers>(shifted.numbers()) << 52) + std::uint64_t{0x3FF0000000000000};
  return {r, Lanes(reinterpret_cast<Register>(bits))};
}

constexpr double inverse_factorials[15] = {1.0,
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
                                           1.0 / 6227020800.0,
                                           1.0 / 87178291200.0};

/// Sum of r^k/(k + first)! for k = 0 to 13; in pairs and pairs of these (Estrin), which wait for
/// one another less than Horner's nesting.
template <int first>
FURROW_INLINE Lanes exponential_series(const Lanes& r) {
  const Lanes r2 = r * r, r4 = r2 * r2, r8 = r4 * r4;
  const auto pair = [&](int k) __attribute__((always_inline)) {
    return Lanes(inverse_factorials[k + first + 1]) * r + Lanes(inverse_factorials[k + first]);
  };
  const auto four = [&](int k) __attribute__((always_inline)) {
    return pair(k + 2) * r2 + pair(k);
  };
  return (pair(12) * r4 + four(8)) * r8 + (four(4) * r4 + four(0));
}

/// exp(a) to about one unit in the last place: the Taylor series of exp(r) to r^13 / 13!, whose
/// rest is below 5e-18. Underflows to 0, overflows to infinity, keeps not-a-number.
FURROW_INLINE Lanes exponential(const Lanes& a) {
  const ReducedExponent reduced = reduced_exponent(a);
  Lanes result = exponential_series<0>(reduced.r) * reduced.power;
  result = select(a < Lanes(-708.3), 0.0, result);
  result = select(a > Lanes(709.7), Lanes(__builtin_inf()), result);
  return select(a == a, result, a);
}

/// exp(a) - 1 to about one unit in the last place of it, for a up to 709.7; keeps not-a-number.
FURROW_INLINE Lanes exponential_minus_one(const Lanes& a) {
  const ReducedExponent reduced = reduced_exponent(a);
  const Lanes result =
      exponential_series<1>(reduced.r) * reduced.r * reduced.power + (reduced.power - Lanes(1.0));
  return select(a == a, result, a);
}

/// log(a) to about one unit in the last place. With a = m 2^n and sqrt(1/2) <= m < sqrt(2), log(m)
/// = 2 artanh((m - 1)/(m + 1)), whose series to the power 23 has an error below 1e-18. Values that
/// are not normal positive numbers use the logarithm of the library.
FURROW_INLINE Lanes logarithm(const Lanes& a) {
  if (!all(a >= Lanes(2.3e-308) && a <= Lanes(1.7e308)))
    return per_lane(a, [](double x) { return __builtin_log(x); });
  constexpr std::uint64_t half_root = 0x3FE6A09E667F3BCD;  // sqrt(1/2)
  constexpr std::uint64_t bias = 1024;                     // keeps exponents positive
  const Integers bits = reinterpret_cast<Integers>(a.numbers());
  // the exponent that remains above sqrt(1/2), as the last bits of 2^52 + 2^51
  const Integers exponent = (bits - (half_root - (bias << 52))) >> 52;
  const Integers mantissa = bits - (exponent << 52) + (bias << 52);
  const Integers shifted = exponent + (std::uint64_t{0x4338000000000000} - bias);
  const Lanes m(reinterpret_cast<Register>(mantissa));
  const Lanes n = Lanes(reinterpret_cast<Register>(shifted)) - Lanes(6755399441055744.0);
  const Lanes s = (m - Lanes(1.0)) / (m + Lanes(1.0)), square = s * s;
  Lanes sum = 1.0 / 23.0;
  for (int k = 21; k >= 3; k -= 2) sum = sum * square + Lanes(1.0 / k);
  const Lanes tail = Lanes(2.0) * s * square * sum + n * Lanes(1.90821492927058770002e-10);
  return n * Lanes(0.693147180369123816490) + (Lanes(2.0) * s + tail);
}

}  // namespace FURROW_ISA
}  // namespace furrow
