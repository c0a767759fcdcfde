// SPDX-License-Identifier: GPL-2.0-or-later
// The length that ground gets without `length`: sinkage and resistance of a rolling wheel are those
// of ground twice as long.

#include <cmath>

#include <gtest/gtest.h>

#include "mpm/length_under_wheel.h"
#include "tests/support/wheel_on_ground.h"

namespace furrow {
namespace {

TEST(LengthUnderWheel, IsTheChordAndTheDepthOnEitherSideToTwoDigits) {
  EXPECT_EQ(length_under_wheel(0.37, 0.2), 1.1);    // 2 (sqrt(0.2 * 0.54) + 0.2) = 1.057
  EXPECT_EQ(length_under_wheel(0.37, 0.5), 1.8);    // deeper than the radius: 2 (0.37 + 0.5)
  EXPECT_EQ(length_under_wheel(0.05, 0.01), 0.08);  // 2 (0.03 + 0.01)
}

struct Rolling {
  double sinkage = 0.0;     // [m]
  double resistance = 0.0;  // horizontal force over vertical load
};

/// Means over the last 0.15 m of 0.4 m, on fresh snow.
Rolling roll(double length) {
  constexpr double distance = 0.4;
  WheelOnGround scene({0.05, length, 0.35, WheelOnGround::Ground{}.material, 0.65});
  double fx = 0.0, fz = 0.0, sinkage = 0.0, count = 0.0;
  while (scene.time() < WheelOnGround::end_of(distance)) {
    scene.step();
    if (scene.travel() < distance - 0.15) continue;
    fx += scene.contact().force().x();
    fz += scene.contact().force().z();
    sinkage += scene.sinkage();
    count += 1.0;
  }
  return {sinkage / count, -fx / fz};
}

TEST(LengthUnderWheel, TwiceAsMuchGroundChangesNeitherSinkageNorResistance) {
  const double length = length_under_wheel(WheelOnGround::radius, WheelOnGround::depth);
  const Rolling as_chosen = roll(length), twice = roll(2.0 * length), less = roll(0.6 * length);
  EXPECT_NEAR(as_chosen.sinkage, twice.sinkage, 1e-3 * twice.sinkage);
  EXPECT_NEAR(as_chosen.resistance, twice.resistance, 3e-3 * std::abs(twice.resistance));
  // ground that is too short holds the wheel up
  EXPECT_GT(std::abs(less.resistance - twice.resistance), 5e-2 * std::abs(twice.resistance));
}

}  // namespace
}  // namespace furrow
