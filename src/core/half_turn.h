// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Half a turn's cosine and sine while it is small, of one number or of several in lanes.

namespace furrow {

template <class Number>
struct HalfTurn {
  Number cosine, sinc;  ///< cos a, sin(a)/a
};

constexpr double small_half_turn = 1e-4;  ///< largest a^2 [rad^2] of the series, to 1e-21

/// By series. @param squared a^2 [rad^2]
template <class Number>
[[gnu::always_inline]] inline HalfTurn<Number> half_turn(const Number& squared) {
  const Number one = 1.0;
  return {one - squared * 0.5 *
                    (one - squared * (1.0 / 12.0) *
                               (one - squared * (1.0 / 30.0) * (one - squared * (1.0 / 56.0)))),
          one - squared * (1.0 / 6.0) *
                    (one - squared * (1.0 / 20.0) * (one - squared * (1.0 / 42.0)))};
}

}  // namespace furrow
