// SPDX-License-Identifier: GPL-2.0-or-later
// The length and width that ground gets without `length` and `width`: sinkage and resistance of a
// rolling wheel are those of ground twice as long, and twice as wide.

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "furrow/mpm/ground/ground_under_wheel.h"
#include "tests/support/wheel_on_ground.h"

namespace furrow::ground_under_wheel_test {
namespace {

TEST(GroundUnderWheel, SizeIsChordOrWidthPlusDepthOnEachSide) {
  EXPECT_EQ(ground_under_wheel(0.37, 0.272, 0.2).length,
            1.1);  // 2 (sqrt(0.2 * 0.54) + 0.2) = 1.057
  EXPECT_EQ(ground_under_wheel(0.37, 0.272, 0.5).length, 1.8);   // deeper than r: 2 (0.37 + 0.5)
  EXPECT_EQ(ground_under_wheel(0.05, 0.02, 0.01).length, 0.08);  // 2 (0.03 + 0.01)
  EXPECT_EQ(ground_under_wheel(0.37, 0.272, 0.2).width, 0.68);   // 0.272 + 0.4
  EXPECT_EQ(ground_under_wheel(0.05, 0.02, 0.01).width, 0.04);
  EXPECT_EQ(ground_under_wheel(0.37, 0.272, 0.2).fine_width, 0.38);  // 0.272 + 0.1
}

struct Rolling {
  double sinkage = 0.0;     // [m]
  double resistance = 0.0;  // horizontal force over vertical load
};

/// Means over the last 0.3 m of 0.55 m, on fresh snow.
Rolling roll(const GroundSize& ground) {
  constexpr double distance = 0.55;
  WheelOnGround scene(
      {0.05, ground.length, 0.5 * ground.width, WheelOnGround::Ground{}.material, 0.65});
  double fx = 0.0, fz = 0.0, sinkage = 0.0, count = 0.0;
  while (scene.time() < WheelOnGround::end_of(distance)) {
    scene.step();
    if (scene.travel() < distance - 0.3) continue;
    fx += scene.contact().force().x();
    fz += scene.contact().force().z();
    sinkage += scene.sinkage();
    count += 1.0;
  }
  return {sinkage / count, -fx / fz};
}

TEST(GroundUnderWheel, DoubledSizeChangesNeitherSinkageNorResistance) {
  const GroundSize size =
      ground_under_wheel(WheelOnGround::radius, WheelOnGround::width, WheelOnGround::depth);
  const double narrow = WheelOnGround::width + 0.5 * WheelOnGround::depth;
  const Rolling as_chosen = roll(size), longer = roll({2.0 * size.length, size.width}),
                wider = roll({size.length, 2.0 * size.width}),
                shorter = roll({0.6 * size.length, size.width}),
                narrower = roll({size.length, narrow});
  const auto record = [&](const char* name, const Rolling& r) {
    RecordProperty(name, fmt::format("sinkage {:.5f}, resistance {:.5f}", r.sinkage, r.resistance));
  };
  record("as_chosen", as_chosen);
  record("longer", longer);
  record("wider", wider);
  record("shorter", shorter);
  record("narrower", narrower);
  for (const Rolling& twice : {longer, wider}) {
    EXPECT_NEAR(as_chosen.sinkage, twice.sinkage, 1e-3 * twice.sinkage);
    EXPECT_NEAR(as_chosen.resistance, twice.resistance, 1e-3);  // of the load
  }
  // ground that is too short or too narrow holds the wheel up
  for (const Rolling& less : {shorter, narrower})
    EXPECT_GT(std::abs(less.resistance - as_chosen.resistance), 1.5e-3);
}

}  // namespace
}  // namespace furrow::ground_under_wheel_test
