// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/rig/slip.h"

#include <cmath>

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "tests/support/error_of.h"

namespace furrow::slip_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;
constexpr auto larger = SlipDefinition::larger_speed, by_rim = SlipDefinition::rim_speed,
               by_vehicle = SlipDefinition::vehicle_speed;

// The rim speeds of the CMU tests at 10 mm/s and the slips printed with them.
TEST(Slip, DefinitionByTheLargerSpeedGivesTheSandTests) {
  const std::vector<std::pair<double, double>> rim_and_slip{
      {0, -1.0}, {3, -0.7}, {5, -0.5}, {8, -0.2}, {10, 0.0}, {20, 0.5}, {40, 0.75}, {100, 0.9}};
  for (const auto& [rim, expected] : rim_and_slip) {
    EXPECT_NEAR(slip(larger, rim, 10.0), expected, 1e-15);
    EXPECT_NEAR(rim_speed(larger, expected, 10.0), rim, 1e-13);
  }
}

TEST(Slip, RimAndVehicleSpeedAreTheTwoBranches) {
  EXPECT_DOUBLE_EQ(slip(by_vehicle, 3.0, 2.0), 0.5);  // [Shoop2001], eq. 28
  EXPECT_DOUBLE_EQ(slip(by_rim, 3.0, 2.0), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(slip(larger, 3.0, 2.0), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(slip(larger, 1.0, 2.0), -0.5);
  EXPECT_DOUBLE_EQ(slip(by_vehicle, 1.0, 2.0), -0.5);
  EXPECT_DOUBLE_EQ(slip(by_rim, 1.0, 2.0), -1.0);
}

/// The slip by another definition of the motion that has this one.
double converted(double value, SlipDefinition from, SlipDefinition to) {
  return slip(to, rim_speed(from, value, 1.0), 1.0);
}

TEST(Slip, ConversionsAreInverse) {
  EXPECT_DOUBLE_EQ(converted(0.2, by_rim, by_vehicle), 0.25);  // i = s/(1 - s)
  for (const double s : {-0.9, -0.3, 0.0, 0.3, 0.9})
    for (const auto other : {by_rim, by_vehicle})
      EXPECT_NEAR(converted(converted(s, larger, other), other, larger), s, 1e-14);
}

TEST(Slip, UndefinedSlipIsRefused) {
  EXPECT_THAT(error_of([] { slip(larger, 0.0, 0.0); }),
              HasSubstr("not defined at a rim speed of 0 m/s and a vehicle speed of 0 m/s"));
  EXPECT_THAT(error_of([] { slip(by_rim, 0.0, 1.0); }),
              HasSubstr("slip (v_rim - v)/v_rim is not defined"));
  EXPECT_THAT(error_of([] { slip(by_vehicle, 1.0, 0.0); }),
              HasSubstr("slip (v_rim - v)/v is not defined"));
  EXPECT_THAT(error_of([] { rim_speed(larger, 0.2, 0.0); }),
              HasSubstr("vehicle speed of 0 m/s; allowed: a speed > 0"));
  EXPECT_THAT(error_of([] { rim_speed(larger, 1.0, 1.0); }),
              HasSubstr("of 1; allowed: -1 <= slip < 1"));
  EXPECT_THAT(error_of([] { rim_speed(larger, -1.1, 1.0); }), HasSubstr("allowed: -1 <= slip < 1"));
  EXPECT_THAT(error_of([] { rim_speed(by_rim, 1.0, 1.0); }), HasSubstr("allowed: slip < 1"));
  EXPECT_THAT(error_of([] { rim_speed(by_vehicle, -1.5, 1.0); }), HasSubstr("allowed: slip >= -1"));
  EXPECT_THAT(error_of([] { rim_speed(by_vehicle, std::nan(""), 1.0); }),
              HasSubstr("no forward spin"));
  EXPECT_THAT(error_of([] { converted(-1.0, larger, by_rim); }),
              HasSubstr("is not defined at a rim speed of 0"));
}

TEST(Slip, NamesSelectTheDefinitions) {
  for (const auto definition : {larger, by_rim, by_vehicle})
    EXPECT_EQ(slip_definition(slip_definition_words()[static_cast<std::size_t>(definition)]),
              definition);
  EXPECT_EQ(slip_definition("vehicle_speed"), by_vehicle);
  EXPECT_EQ(slip_formula(by_vehicle), "(v_rim - v)/v");
  EXPECT_THAT(error_of([] { slip_definition("skid"); }), HasSubstr("no slip definition 'skid'"));
}

}  // namespace
}  // namespace furrow::slip_test
