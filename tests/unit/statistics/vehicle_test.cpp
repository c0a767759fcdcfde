// SPDX-License-Identifier: GPL-2.0-or-later
// Two wheels on one continuum, whose energies grow by known amounts for each metre.

#include "furrow/statistics/vehicle.h"

#include <map>

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "furrow/rig/wheel_rig.h"
#include "tests/support/error_of.h"

namespace furrow::vehicle_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;

/// Resistances of a wheel [N]. The parts of the ground are those of both wheels, and their sum is
/// that of both works on the continuum.
struct Wheel {
  double load, put_in, continuum, friction, springs, tyre;
};
constexpr Wheel front{100.0, 30.0, 25.0, 3.0, 1.5, 0.5}, rear{80.0, 10.0, 8.0, 1.0, 0.5, 0.5};
constexpr double compaction = 20.0, bulldozing = 10.0, grid = 3.0;

/// 4 s of cruise at 1 m/s; @param first [s] of its rows
History history_of(const Wheel& wheel, double first = 0.0, bool ground = true) {
  History history(WheelRig::channels());
  for (int i = 0; i <= 2000; ++i) {
    const double t = first + 0.002 * i;
    const std::map<std::string, double> values = {{"time", t},
                                                  {"stage", 2.0},
                                                  {"pass", 1.0},
                                                  {"x", t},
                                                  {"hub_drop", 0.03},
                                                  {"force_z", wheel.load},
                                                  {"force_x", -wheel.put_in},
                                                  {"drawbar_pull", -wheel.put_in},
                                                  {"drive_work", wheel.put_in * t},
                                                  {"continuum_work", wheel.continuum * t},
                                                  {"friction_loss", wheel.friction * t},
                                                  {"contact_spring_loss", wheel.springs * t},
                                                  {"wheel_loss", wheel.tyre * t},
                                                  {"compaction_work", ground * compaction * t},
                                                  {"bulldozing_work", ground * bulldozing * t},
                                                  {"grid_loss", ground * grid * t}};
    std::vector<double> row;
    for (const Channel& channel : history.channels())
      row.push_back(values.count(channel.name) ? values.at(channel.name) : 0.0);
    history.append(row);
  }
  return history;
}

std::map<std::string, double> forces(const ResistanceParts& parts) {
  std::map<std::string, double> found{{"whole", parts.whole}, {"unexplained", parts.unexplained}};
  for (const ResistancePart& part : parts.parts) found[part.name] = part.force;
  return found;
}

void expect_forces(const ResistanceParts& parts, std::map<std::string, double> expected) {
  const std::map<std::string, double> found = forces(parts);
  for (const auto& [name, force] : found) EXPECT_NEAR(force, expected[name], 1e-9) << name;
  EXPECT_EQ(found.size(), expected.size());
}

TEST(Vehicle, SingleWheelReportsTheSharedContinuumAsOnePart) {
  expect_forces(measure_resistance(history_of(rear)).parts, {{"whole", 10.0},
                                                             {"continuum, shared with others", 8.0},
                                                             {"friction of wheel and ground", 1.0},
                                                             {"contact springs and damping", 0.5},
                                                             {"wheel or tyre", 0.5},
                                                             {"unexplained", 0.0}});
}

TEST(Vehicle, AllWheelsTogetherGiveThePartsOfTheContinuum) {
  const VehicleResistance vehicle = measure_vehicle({history_of(front), history_of(rear)});
  expect_forces(vehicle.parts, {{"whole", 40.0},
                                {"compaction", compaction},
                                {"bulldozing", bulldozing},
                                {"grid", grid},
                                {"friction of wheel and ground", 4.0},
                                {"contact springs and damping", 2.0},
                                {"wheel or tyre", 1.0},
                                {"unexplained", 0.0}});
  ASSERT_EQ(vehicle.wheels.size(), 2u);
  EXPECT_NEAR(vehicle.wheels[1].value("resistance_coefficient").mean, 10.0 / 80.0, 1e-12);
  ASSERT_EQ(vehicle.values.size(), 3u);
  EXPECT_NEAR(vehicle.values[0].mean, 180.0, 1e-9);
  EXPECT_NEAR(vehicle.values[1].mean, 40.0 / 180.0, 1e-12);
  EXPECT_NEAR(vehicle.values[2].mean, -40.0, 1e-9);
}

/// A remainder that nothing accounts for is shown, not hidden in a part.
TEST(Vehicle, MissingEnergyIsReportedAsUnexplained) {
  Wheel other = rear;
  other.put_in += 2.0;
  EXPECT_NEAR(measure_vehicle({history_of(front), history_of(other)}).parts.unexplained, 2.0, 1e-9);
}

TEST(Vehicle, ContinuumIsOnePartWithoutRecordedParts) {
  const VehicleResistance vehicle =
      measure_vehicle({history_of(front, 0.0, false), history_of(rear, 0.0, false)});
  EXPECT_NEAR(forces(vehicle.parts)["continuum, shared with others"], 33.0, 1e-9);
}

TEST(Vehicle, WheelsOfDifferentRunsAreRefused) {
  EXPECT_THAT(error_of<Error>([] {
                measure_vehicle({history_of(front), history_of(rear, 9.0)});
              }),
              HasSubstr("the wheels have no common stretch of cruise"));
  EXPECT_THAT(error_of<Error>([] {
                measure_vehicle({history_of(front), history_of(rear, 0.0011)});
              }),
              HasSubstr("not of the same times"));
}

}  // namespace
}  // namespace furrow::vehicle_test
