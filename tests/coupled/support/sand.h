// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A small bed of sand in a box that closes on itself along x, at rest.

#include "tests/coupled/support/scene.h"

namespace furrow::test {

inline constexpr char hertz[] = "model hertz tangential history rolling_friction epsd2";

struct SandBed {
  static constexpr double length = 0.24;     ///< [m] the period
  static constexpr double diameter = 0.008;  ///< [m] of all grains
  static constexpr double step = 4e-5;       ///< [s]
  static constexpr double gravity = 9.81;    ///< [m/s^2]
};

/// 1000 grains between walls at y = -0.03 and 0.03 m (fixes left and right) on z = 0 (fix floor),
/// in a box that ends `beside` those walls [m]. All grains are moved by fix move.
void make_sand_bed(Scene& scene, double beside = 0.01);

}  // namespace furrow::test
