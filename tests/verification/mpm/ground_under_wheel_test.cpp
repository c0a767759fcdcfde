// SPDX-License-Identifier: GPL-2.0-or-later
// The length, width and cells that ground gets without `length`, `width` and `cell`: sinkage and
// resistance of a rolling wheel are those of ground twice as long, and twice as wide.

#include <cmath>
#include <string>
#include <vector>

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

GroundSize chosen(const WheelDetails& wheel, double depth, bool thin_parts = false) {
  GroundSize size;
  choose_cell(size, wheel, depth, thin_parts);
  return size;
}

TEST(GroundUnderWheel, CellIsAnEighthOfTheWidth) {
  const GroundSize size = chosen({0.37, 0.272}, 0.5);
  EXPECT_EQ(size.cell, 0.034);
  EXPECT_NEAR(size.fine_depth, 0.306, 1e-12);  // 1.1 * 0.272 = 0.2992: 9 cells
  EXPECT_STREQ(size.cell_by, "the wheel's width");
  EXPECT_EQ(chosen({0.37, 0.279}, 0.6).cell, 0.034);  // 0.0349 down to two digits
}

TEST(GroundUnderWheel, WholeCellsFillShallowGround) {
  const GroundSize size = chosen({0.37, 0.272}, 0.2);
  EXPECT_EQ(size.cell, 0.033);  // 5.88 cells of 0.034: six of 0.0333
  EXPECT_EQ(size.fine_depth, 0.0);
  const GroundSize deeper = chosen({0.37, 0.272}, 0.47);  // 4.8 cells below 0.306
  EXPECT_EQ(deeper.cell, 0.033);                          // 13.8 cells: 14 of 0.03357
  EXPECT_EQ(deeper.fine_depth, 0.0);
  const GroundSize thin = chosen({0.37, 0.272}, 0.1);
  EXPECT_EQ(thin.cell, 0.025);
  EXPECT_STREQ(thin.cell_by, "the depth");
}

TEST(GroundUnderWheel, CellShowsRadiusGroovesAndGrousers) {
  const GroundSize roller = chosen({0.1, 1.0}, 0.5);
  EXPECT_EQ(roller.cell, 0.025);
  EXPECT_STREQ(roller.cell_by, "the wheel's radius");
  const GroundSize grooved = chosen({0.37, 0.235, 0.016}, 0.5);
  EXPECT_EQ(grooved.cell, 0.0053);
  EXPECT_STREQ(grooved.cell_by, "the grooves of the tread");
  const WheelDetails rover = {0.225, 0.2, WheelDetails::none, 0.03, 0.06};
  EXPECT_EQ(chosen(rover, 0.5).cell, 0.006);
  EXPECT_EQ(chosen(rover, 0.5, true).cell, 0.012);
  EXPECT_STREQ(chosen(rover, 0.5).cell_by, "the height of the grousers");
  const WheelDetails dense = {0.225, 0.2, WheelDetails::none, 0.03, 0.025};
  EXPECT_EQ(chosen(dense, 0.5, true).cell, 0.01);
  EXPECT_STREQ(chosen(dense, 0.5, true).cell_by, "the spacing of the grousers");
}

TEST(GroundUnderWheel, DetailsAreThoseOfTheWheel) {
  const auto wheel = [](std::vector<std::string> more) {
    std::vector<std::string> line = {"diameter", "0.4", "width", "0.15", "mass", "5",
                                     "inertia",  "0.1", "axle",  "0",    "0",    "0"};
    line.insert(line.end(), more.begin(), more.end());
    return details_of(RigidWheel(RigidWheel::schema().read(line)));
  };
  const WheelDetails smooth = wheel({}), barred = wheel({"grousers", "20", "grouser_height", "0.01",
                                                         "grouser_thickness", "0.004"});
  EXPECT_EQ(smooth.radius, 0.2);
  EXPECT_EQ(smooth.width, 0.15);
  EXPECT_EQ(smooth.grouser_height, WheelDetails::none);
  EXPECT_NEAR(barred.grouser_height, 0.01, 1e-12);
  EXPECT_NEAR(barred.grouser_spacing, 0.02 * pi, 1e-12);
  EXPECT_EQ(barred.groove, WheelDetails::none);
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
