// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/rig/wheel_rig.h"
#include "furrow/statistics/history.h"

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "made_again.h"
#include "wheel_on_floor.h"
#include "tests/support/error_of.h"

namespace furrow::wheel_rig_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;
const std::string stages = " settle_time 0.2 accelerate_time 0.2 ground_level 0";

WheelRig make_rig(RigidWheel& wheel, const std::string& line) {
  return rig_of(wheel, line, stages);
}

std::string refusal_of(const std::string& line) {
  RigidWheel wheel = make_wheel();
  return error_of<InputError>([&] { make_rig(wheel, line); });
}

std::size_t channel(const std::string& name) { return History(WheelRig::channels()).index(name); }

/// Means over the rows of the cruise.
struct CruiseMean {
  std::vector<double> sums = std::vector<double>(WheelRig::channels().size(), 0.0);
  long rows = 0;
  double after = 0.0;
  void operator()(const std::vector<double>& row) {
    if (row[0] < after) return;
    for (std::size_t i = 0; i < row.size(); ++i) sums[i] += row[i];
    ++rows;
  }
  double of(const std::string& name) const {
    return sums[channel(name)] / static_cast<double>(rows);
  }
};

/// The wheel of make_wheel() at a height above a floor: largest force, and height at the end [N,
/// m].
std::pair<double, double> lowered(double gap, const std::string& more = "") {
  RigidWheel wheel = make_wheel(0.2 + gap);
  WheelRig rig = make_rig(wheel, "load_force 60 speed 0 mode towed damping 60 " + more);
  const Floor floor;
  double largest = 0.0;
  run(rig, wheel, 0.4, 1e-4, &floor, [&](const std::vector<double>& row) {
    largest = std::max(largest, row[channel("force_z")]);
  });
  return {largest, wheel.centre().z()};
}

TEST(WheelRig, InitialHeightDoesNotChangeTheSettledHeight) {
  const double rest = lowered(0.0).second;
  for (const double gap : {1e-5, 1e-3, 0.02, 0.1, 0.5}) {
    const auto [largest, height] = lowered(gap);
    EXPECT_LT(largest, 1.05 * 60.0) << gap;
    EXPECT_NEAR(height, rest, 2e-6) << gap;
  }
  EXPECT_GT(lowered(0.02, "release in_air").first, 2.0 * 60.0);
}

/// Ground that lies lower than stated is reached at a creep, ground that lies higher stops the
/// wheel.
TEST(WheelRig, WheelIsLoweredToGroundOfAnotherLevel) {
  for (const double level : {-5e-4, 2e-3}) {
    RigidWheel wheel = make_wheel(0.23);
    WheelRig rig =
        rig_of(wheel, fmt::format("load_force 60 speed 1 mode towed damping 60 settle_time 0.4 "
                                  "accelerate_time 0.2 ground_level {}",
                                  level));
    const Floor floor;
    double largest = 0.0;
    run(rig, wheel, 0.4, 1e-4, &floor, [&](const std::vector<double>& row) {
      largest = std::max(largest, row[channel("force_z")]);
    });
    EXPECT_LT(largest, 1.3 * 60.0) << level;
    EXPECT_NEAR(wheel.ground_wrench().force.z(), 60.0, 1.0) << level;
  }
}

TEST(WheelRig, RowHasOneValuePerChannel) {
  RigidWheel wheel = make_wheel();
  const WheelRig rig = make_rig(wheel, "load_force 60 speed 1 mode towed");
  EXPECT_EQ(rig.measure(0.0).size(), WheelRig::channels().size());
  EXPECT_EQ(WheelRig::channels().front().name, "time");
  for (const Channel& each : WheelRig::channels()) EXPECT_FALSE(each.meaning.empty());
}

/// Other targets, as Python sets them.
std::string refused_targets(WheelRig& rig, const std::string& line) {
  return error_of<InputError>(
      [&] { rig.retarget(WheelRig::schema("fix wheel/rig").read(test::words(line, stages))); });
}

TEST(WheelRig, RefusedTargetsLeaveTheDraggedMass) {
  RigidWheel wheel = make_wheel();
  const std::string heavier = "load_mass 30 mode torque travel free torque ";
  WheelRig rig = make_rig(wheel, "load_mass 15 mode torque travel free torque 1");
  EXPECT_THAT(refused_targets(rig, heavier + "1e9"), HasSubstr("'torque'"));
  const auto speed_after_a_push = [&] {
    wheel.hold(Coordinate::x);
    wheel.advance(1e-3);
    wheel.release(Coordinate::x);
    wheel.set_load({10.0, 0.0, 0.0});
    wheel.advance(1e-3);
    return wheel.velocity().x();
  };
  EXPECT_NEAR(speed_after_a_push(), 10.0 * 1e-3 / 15.0, 1e-12);
  EXPECT_EQ(refused_targets(rig, heavier + "1"), "no error");
  EXPECT_NEAR(speed_after_a_push(), 10.0 * 1e-3 / 30.0, 1e-12);
}

TEST(WheelRig, SprungMassIsThatOfTheScript) {
  RigidWheel wheel = make_wheel();
  const std::string sprung = "mode towed speed 1 suspension_stiffness 4000 load_mass ";
  WheelRig rig = make_rig(wheel, sprung + "15");
  EXPECT_EQ(refused_targets(rig, sprung + "15"), "no error");
  EXPECT_THAT(refused_targets(rig, sprung + "30"), HasSubstr("sprung mass"));
}

TEST(WheelRig, PhasesFollowTheClock) {
  RigidWheel wheel = make_wheel();
  const WheelRig rig = make_rig(wheel, "load_force 60 speed 1 mode towed start 1");
  EXPECT_EQ(rig.stage(0.5), RigStage::settle);
  EXPECT_EQ(rig.stage(1.19), RigStage::settle);
  EXPECT_EQ(rig.stage(1.21), RigStage::accelerate);
  EXPECT_EQ(rig.stage(1.41), RigStage::cruise);
  EXPECT_DOUBLE_EQ(rig.cruise_start(), 1.4);
}

TEST(WheelRig, LoadIsAMassOrAForceWithTheWheel) {
  RigidWheel wheel = make_wheel();
  EXPECT_DOUBLE_EQ(make_rig(wheel, "load_mass 5 speed 1 mode towed").load(), 5.0 * 9.80665);
  EXPECT_DOUBLE_EQ(make_rig(wheel, "load_mass 5 gravity 1.62 speed 1 mode towed").load(),
                   5.0 * 1.62);
  EXPECT_DOUBLE_EQ(make_rig(wheel, "load_force 60 speed 1 mode towed").load(), 60.0);
}

// Without ground: the impulse of the ramped load is momentum, z'(t) = -(W/m) times the integral of
// the ramp.
TEST(WheelRig, LoadFallsFreelyWithoutGround) {
  RigidWheel wheel = make_wheel();
  WheelRig rig = make_rig(
      wheel, "load_force 60 speed 0 mode towed load_ramp_time 0.1 start 0.05 release in_air");
  const Ramp ramp{0.05, 0.1};
  run(rig, wheel, 0.3, 1e-4, nullptr, [&](const std::vector<double>& row) {
    ASSERT_NEAR(row[channel("velocity_z")], -60.0 / 3.0 * ramp.integral(row[0]), 60.0 / 3.0 * 1e-4);
  });
  EXPECT_LT(wheel.velocity().z(), -1.0);
}

TEST(WheelRig, WheelIsHeldUntilTheStart) {
  RigidWheel wheel = make_wheel();
  WheelRig rig = make_rig(wheel, "load_force 60 speed 1 mode towed start 0.5");
  run(rig, wheel, 0.5, 1e-3, nullptr,
      [](const std::vector<double>& row) { ASSERT_EQ(row[channel("z")], 0.2); });
}

TEST(WheelRig, PrescribedSinkageIsReachedAndKept) {
  RigidWheel wheel = make_wheel(0.25);
  WheelRig rig = make_rig(wheel, "sinkage 0.03 speed 1 mode towed ground_level 0.02");
  double last = -1.0;
  run(rig, wheel, 0.6, 1e-4, nullptr, [&](const std::vector<double>& row) {
    ASSERT_GE(row[channel("hub_drop")], last - 1e-15);
    last = row[channel("hub_drop")];
    if (row[0] > 0.1) {
      ASSERT_NEAR(last, 0.03, 1e-13);
    }
  });
  EXPECT_NEAR(wheel.centre().z(), 0.02 - 0.03 + 0.2, 1e-13);
}

TEST(WheelRig, PrescribedSlipIsExactFromTheFirstRollingStep) {
  for (const double target : {-1.0, -0.5, 0.0, 0.25, 0.9})
    for (const double angle : {0.0, 20.0}) {
      RigidWheel wheel = make_wheel();
      WheelRig rig = make_rig(
          wheel, fmt::format("sinkage 0 speed 0.8 mode slip slip {} slip_angle {}", target, angle));
      const Ramp ramp{0.2, 0.2};
      run(rig, wheel, 0.6, 1e-4, nullptr, [&](const std::vector<double>& row) {
        if (row[0] > 0.2005) {
          ASSERT_NEAR(row[channel("slip")], target, 1e-12);
        }
        ASSERT_NEAR(row[channel("x")], 0.8 * ramp.integral(row[0]), 1e-13);
      });
      EXPECT_NEAR(wheel.rate(Coordinate::x), 0.8, 1e-15);
      EXPECT_NEAR(
          wheel.axle().dot(Vector3(-std::sin(radians(angle)), std::cos(radians(angle)), 0.0)), 1.0,
          1e-14);
    }
}

TEST(WheelRig, SlipDefinitionsSetTheSameMotionByDifferentNumbers) {
  RigidWheel wheel = make_wheel();
  const auto target = [&](const std::string& definition) {
    return make_rig(wheel, "load_force 60 speed 0.8 mode slip slip_definition " + definition)
        .target_rim_speed();
  };
  EXPECT_DOUBLE_EQ(target("larger_speed slip 0.2"), 1.0);
  EXPECT_DOUBLE_EQ(target("rim_speed slip 0.2"), 1.0);
  EXPECT_DOUBLE_EQ(target("vehicle_speed slip 0.25"), 1.0);
}

// No ground: alpha = T/I, so omega = T/I times the integral of the ramp.
TEST(WheelRig, SpinAccelerationIsTorqueOverInertia) {
  RigidWheel wheel = make_wheel();
  WheelRig rig = make_rig(wheel, "sinkage 0 speed 0 mode torque torque 0.3");
  const Ramp ramp{0.2, 0.2};
  run(rig, wheel, 0.6, 1e-4, nullptr, [&](const std::vector<double>& row) {
    ASSERT_NEAR(row[channel("spin_rate")], 0.3 / 0.06 * ramp.integral(row[0]), 0.3 / 0.06 * 1e-4);
  });
  EXPECT_NEAR(wheel.rate(Coordinate::spin), 1.5, 5e-4);
}

TEST(WheelRig, WheelOnAFloorCarriesItsLoad) {
  RigidWheel wheel = make_wheel(0.2005);
  const Floor floor;
  WheelRig rig = make_rig(wheel, "load_force 60 speed 0 mode towed damping 600");
  std::vector<double> last;
  run(rig, wheel, 0.8, 4e-5, &floor, [&](const std::vector<double>& row) { last = row; });
  EXPECT_NEAR(last[channel("force_z")], 60.0, 1e-6);
  EXPECT_NEAR(last[channel("load")], 60.0, 1e-12);
  EXPECT_GT(last[channel("damping_loss")], 0.0);
  // the damper took the energy that load and rig gave and the floor has not stored
  EXPECT_NEAR(last[channel("contact_work")] + last[channel("load_work")] +
                  last[channel("drive_work")] - last[channel("damping_loss")],
              last[channel("kinetic_energy")], 1e-12);
}

// No axle torque: in steady rolling the moment about the axle, and so the friction, vanishes; the
// wheel rolls at its own speed.
TEST(WheelRig, TowedWheelRollsFreelyOnAFrictionalFloor) {
  RigidWheel wheel = make_wheel(0.2003, 160);
  const Floor floor;
  WheelRig rig = make_rig(wheel, "load_force 60 speed 1 mode towed damping 600");
  CruiseMean mean;
  mean.after = 0.6;
  run(rig, wheel, 1.2, 4e-5, &floor, std::ref(mean));
  EXPECT_NEAR(mean.of("slip"), 0.0, 5e-3);
  EXPECT_NEAR(mean.of("force_z"), 60.0, 0.3);
  EXPECT_NEAR(mean.of("drive_torque"), 0.0, 1e-15);
  EXPECT_NEAR(mean.of("drawbar_pull"), mean.of("force_x"), 0.02);
  EXPECT_NEAR(mean.of("force_x"), 0.0, 0.3);
  EXPECT_NEAR(mean.of("velocity_x"), 1.0, 1e-12);
}

// Coulomb: a wheel that slides over all of its contact pulls mu N, against the sliding; its drive
// supplies mu N r.
TEST(WheelRig, SlidingWheelHasThePullOfFriction) {
  for (const double slip : {-1.0, 0.5}) {
    RigidWheel wheel = make_wheel(0.2003);
    const Floor floor;
    WheelRig rig =
        make_rig(wheel, fmt::format("load_force 60 speed 1 mode slip slip {} damping 600", slip));
    CruiseMean mean;
    mean.after = 0.6;
    run(rig, wheel, 1.2, 4e-5, &floor, std::ref(mean));
    const double pull = (slip > 0.0 ? 1.0 : -1.0) * 0.5 * mean.of("force_z");
    EXPECT_NEAR(mean.of("drawbar_pull"), pull, 0.02);
    EXPECT_NEAR(mean.of("drive_torque"), pull * 0.2, 0.02);
  }
}

// In steady driving the pull times the radius is the torque.
TEST(WheelRig, PullOfADrivenWheelIsTorqueOverRadius) {
  RigidWheel wheel = make_wheel(0.2003, 160);
  const Floor floor;
  WheelRig rig = make_rig(wheel, "load_force 60 speed 1 mode torque torque 2 damping 600");
  CruiseMean mean;
  mean.after = 0.6;
  run(rig, wheel, 1.2, 4e-5, &floor, std::ref(mean));
  EXPECT_NEAR(mean.of("drive_torque"), 2.0, 1e-12);
  EXPECT_NEAR(mean.of("drawbar_pull"), 2.0 / 0.2, 0.3);
  EXPECT_GT(mean.of("slip"), 0.0);
}

TEST(WheelRig, EnergyBalanceClosesOverAWholeRun) {
  RigidWheel wheel = make_wheel(0.2003, 160);
  const Floor floor;
  WheelRig rig =
      make_rig(wheel, "load_mass 6 speed 1 mode slip slip 0.3 damping 100 slip_angle 10");
  std::vector<double> last;
  run(rig, wheel, 0.8, 4e-5, &floor, [&](const std::vector<double>& row) { last = row; });
  const double drive = last[channel("drive_work")];
  EXPECT_GT(std::abs(drive), 1.0);
  EXPECT_NEAR(wheel.energy_budget().residual(), 0.0, 1e-12 * std::abs(drive));
  // friction against the sliding of the tread, v - v_rim x heading
  const double rim = rig.target_rim_speed(), heading = radians(10.0);
  EXPECT_NEAR(rim, std::cos(heading) / 0.7, 1e-15);
  EXPECT_NEAR(last[channel("force_y")] / last[channel("force_x")],
              rim * std::sin(heading) / (rim * std::cos(heading) - 1.0), 0.02);
}

TEST(WheelRig, RestartContinuesBitwise) {
  expect_continues_bitwise("load_mass 6 speed 1 mode towed damping 100 slip_angle 10" + stages,
                           Floor(), 3000, 5000);
}

TEST(Course, CourseIsLinearBetweenItsPointsAndConstantOutside) {
  const Course course({{1.0, 10.0}, {3.0, 20.0}, {4.0, 0.0}});
  EXPECT_EQ(course.value(0.0), 10.0);
  EXPECT_EQ(course.value(1.0), 10.0);
  EXPECT_DOUBLE_EQ(course.value(2.5), 17.5);
  EXPECT_DOUBLE_EQ(course.value(3.75), 5.0);
  EXPECT_EQ(course.value(4.0), 0.0);
  EXPECT_EQ(course.value(9.0), 0.0);
}

// The cruise begins at 0.4 s. Velocities are those of the middle of the step.
TEST(WheelRig, TargetsFollowTheirRampsFromTheStartOfTheCruise) {
  constexpr double dt = 1e-4, cruise = 0.4;
  RigidWheel wheel = make_wheel();
  WheelRig rig = make_rig(wheel,
                          "load_force_ramp 0 60 0.2 90 speed 0.8 mode slip slip_ramp 0 -0.2 0.2 "
                          "0.6 slip_angle_ramp 0.1 5 0.3 25");
  const Course load({{0.0, 60.0}, {0.2, 90.0}}), slip({{0.0, -0.2}, {0.2, 0.6}}),
      angle({{0.1, 5.0}, {0.3, 25.0}});
  run(rig, wheel, 0.8, dt, nullptr, [&](const std::vector<double>& row) {
    const double middle = row[0] - 0.5 * dt - cruise;
    if (row[0] < 0.2005) return;
    ASSERT_NEAR(row[channel("load")], load.value(middle), 1e-11);
    ASSERT_NEAR(degrees(wheel.position(Coordinate::yaw)), angle.value(row[0] - cruise), 1e-11);
    // the slip is that of the heading in the middle of the step, half a step before the row's
    ASSERT_NEAR(row[channel("slip")], slip.value(middle), 1e-4);
  });
  EXPECT_DOUBLE_EQ(rig.load(), 90.0);
  EXPECT_NEAR(rig.target_rim_speed(), 0.8 * std::cos(radians(25.0)) / 0.4, 1e-12);
}

TEST(WheelRig, SpinRateFollowsItsRampWithTheAxleFree) {
  RigidWheel wheel = make_wheel();
  WheelRig rig = make_rig(wheel, "load_force 60 travel free mode spin spin_rate_ramp 0 2 0.2 6");
  run(rig, wheel, 0.5, 1e-4, nullptr, [](const std::vector<double>&) {});
  EXPECT_NEAR(wheel.rate(Coordinate::spin), 2.0 + 4.0 * (0.1 - 0.5e-4) / 0.2, 1e-12);
}

TEST(WheelRig, RadiusAndSpeedOfSlipSetTheSpinAndTheRecordedSlip) {
  const auto spin_of = [](const std::string& definition) {
    RigidWheel wheel = make_wheel();
    WheelRig rig =
        make_rig(wheel, "load_force 60 speed 0.8 mode slip slip 0.5 slip_angle 20 " + definition);
    run(rig, wheel, 0.5, 1e-4, nullptr, [](const std::vector<double>& row) {
      if (row[0] > 0.2005) {
        ASSERT_NEAR(row[channel("slip")], 0.5, 1e-12);
      }
    });
    return wheel.rate(Coordinate::spin);
  };
  const double forward = 0.8 * std::cos(radians(20.0));
  EXPECT_NEAR(spin_of({}), forward / 0.5 / 0.2, 1e-12);
  EXPECT_NEAR(spin_of("slip_speed total"), 0.8 / 0.5 / 0.2, 1e-12);
  EXPECT_NEAR(spin_of("slip_radius effective effective_radius 0.19"), forward / 0.5 / 0.19, 1e-12);
}

TEST(WheelRig, TipRadiusIncludesGrousers) {
  RigidWheelParameters parameters = make_wheel().parameters();
  parameters.geometry.grousers = {12, 0.02, 0.01, 0.0};
  RigidWheel wheel(parameters);
  WheelRig rig = make_rig(wheel, "load_force 60 speed 1.1 mode slip slip 0.5 slip_radius tip");
  double pitches = 0.0;
  run(rig, wheel, 0.6, 1e-4, nullptr,
      [&](const std::vector<double>& row) { pitches = row[channel("grouser_pitches")]; });
  EXPECT_NEAR(wheel.rate(Coordinate::spin), 1.1 / 0.5 / 0.22, 1e-12);
  EXPECT_NEAR(pitches, 12.0 * wheel.position(Coordinate::spin) / (2.0 * pi), 1e-12);
  EXPECT_THAT(rig.recorded_channels()[channel("slip")].meaning,
              HasSubstr("v_rim = spin rate x tip radius 0.22 m, v = forward speed"));
}

// Coulomb friction opposes the travel, for any heading of a locked wheel.
TEST(WheelRig, TractiveAndLateralForceFollowTheWheelFrame) {
  RigidWheel wheel = make_wheel(0.2003);
  const Floor floor;
  WheelRig rig =
      make_rig(wheel, "load_force 60 speed 1 mode slip slip -1 slip_angle 20 damping 600");
  CruiseMean mean;
  mean.after = 0.6;
  run(rig, wheel, 1.0, 4e-5, &floor, std::ref(mean));
  const double friction = 0.5 * mean.of("force_z"), psi = radians(20.0);
  EXPECT_NEAR(mean.of("force_x"), -friction, 1e-9);
  EXPECT_NEAR(mean.of("force_y"), 0.0, 1e-9);
  EXPECT_NEAR(mean.of("tractive_force"), -friction * std::cos(psi), 1e-9);
  EXPECT_NEAR(mean.of("lateral_force"), friction * std::sin(psi), 1e-9);
}

// A side slope without friction: the axle and what it drags slide down to the right, y'' = -g sin.
TEST(WheelRig, FreeWheelOnASideSlopeSlidesDownhill) {
  RigidWheel wheel = make_wheel(0.2003);
  Floor floor;
  floor.friction = 0.0;
  WheelRig rig =
      make_rig(wheel, "load_mass 6 speed 1 mode towed side_slope 10 lateral free damping 600");
  std::vector<double> last;
  run(rig, wheel, 0.7, 4e-5, &floor, [&](const std::vector<double>& row) { last = row; });
  const double sine = std::sin(radians(10.0));
  EXPECT_NEAR(last[channel("velocity_y")], -9.80665 * sine * 0.5, 1e-3);
  EXPECT_LT(last[channel("y")], 0.0);
  EXPECT_NEAR(wheel.load().y(), -6.0 * 9.80665 * sine, 1e-12);
  EXPECT_NEAR(wheel.energy_budget().residual(), 0.0, 1e-12 * last[channel("load_work")]);
}

// With friction the side force of the ground carries m g sin, and the load is m g cos.
TEST(WheelRig, SideForceOnASideSlopeIsThatOfTheWeight) {
  for (const double slope : {10.0, -10.0}) {
    RigidWheel wheel = make_wheel(0.2003);
    const Floor floor;
    WheelRig rig = make_rig(
        wheel, fmt::format("load_mass 6 speed 1 mode towed side_slope {} lateral free damping 600",
                           slope));
    CruiseMean mean;
    mean.after = 0.8;
    run(rig, wheel, 1.4, 4e-5, &floor, std::ref(mean));
    const double weight = 6.0 * 9.80665;
    EXPECT_NEAR(mean.of("lateral_force"), weight * std::sin(radians(slope)), 0.005 * weight);
    EXPECT_NEAR(mean.of("force_z"), weight * std::cos(radians(slope)), 0.005 * weight);
    EXPECT_LT(mean.of("velocity_y") * slope, 0.0);
  }
}

TEST(WheelRig, RestartWithRampsContinuesBitwise) {
  const std::string line =
      "load_force_ramp 0 60 0.3 90 speed 1 mode slip slip_ramp 0 0 0.3 0.4 slip_angle_ramp 0 0 0.3 "
      "10 damping 100 side_slope 5 lateral free";
  expect_continues_bitwise(line + stages, Floor(), 4600, 5800);
}

// The settled wheel carries the whole load, and the spring the sprung mass of 4 kg.
TEST(WheelRig, SuspensionCarriesTheSprungMass) {
  RigidWheel wheel = make_wheel(0.2003);
  const Floor floor;
  WheelRig rig = make_rig(wheel,
                          "load_mass 7 speed 0 mode towed damping 600 suspension_stiffness 2000 "
                          "suspension_damping 120 settle_time 1.5");
  std::vector<double> last;
  run(rig, wheel, 1.5, 4e-5, &floor, [&](const std::vector<double>& row) { last = row; });
  const double gravity = 9.80665;
  EXPECT_NEAR(last[channel("force_z")], 7.0 * gravity, 1e-5);
  EXPECT_NEAR(last[channel("suspension_force")], 4.0 * gravity, 1e-5);
  EXPECT_NEAR(last[channel("sprung_drop")], 4.0 * gravity / 2000.0 + 0.2003 - last[channel("z")],
              1e-8);
}

TEST(WheelRig, RestartWithSuspensionContinuesBitwise) {
  const std::string line =
      "load_mass 7 speed 1 mode towed suspension_stiffness 2000 suspension_damping 20";
  expect_continues_bitwise(line + stages, Floor(), 2000, 3000);
}

TEST(WheelRig, SuspensionNeedsASprungMassAndAShortStep) {
  EXPECT_THAT(refusal_of("load_mass 3 speed 1 mode towed suspension_stiffness 1e3"),
              HasSubstr("keyword 'suspension_stiffness' is given, and the load "
                        "is 3 kg; allowed: a load above 3 kg"));
  RigidWheel wheel = make_wheel();
  WheelRig rig = make_rig(wheel, "load_mass 6 speed 1 mode towed suspension_stiffness 1e6");
  EXPECT_THAT(error_of<StateError>([&] { rig.apply(0.05, 1e-3); }),
              HasSubstr("a step of 0.001 s is too long for a suspension"));
}

TEST(WheelRig, RefusesImpossibleCourses) {
  const auto refusal_with = [](const std::string& course) {
    return refusal_of("speed 1 mode slip " + course);
  };
  EXPECT_THAT(refusal_with("load_force 60 slip_ramp 0 0 1"),
              HasSubstr("keyword 'slip_ramp' has 3 numbers; allowed: pairs of time [s] and value"));
  EXPECT_THAT(refusal_with("load_force 60 slip_ramp 0 0 0 0.5"),
              HasSubstr("keyword 'slip_ramp' has the time 0 s after 0 s; allowed: times >= 0 that "
                        "grow; count the time from the start of the cruise"));
  EXPECT_THAT(refusal_with("load_force 60 slip_ramp 0 0 1 1"),
              HasSubstr("keyword 'slip' is 1 with slip_definition larger_speed"));
  EXPECT_THAT(refusal_with("load_force 60 slip 0 slip_ramp 0 0 1 0.5"),
              HasSubstr("keyword 'slip' is given, and it changes over time too"));
  EXPECT_THAT(refusal_with("load_mass 6 load_force_ramp 0 60 slip 0"),
              HasSubstr("has load_mass and a course of load_force"));
  EXPECT_THAT(refusal_with("load_force_ramp 0 60 1 -5 slip 0"),
              HasSubstr("keyword 'load_force_ramp' has the value -5; allowed: a number > 0 [N]"));
  EXPECT_THAT(refusal_of("load_force 60 speed 1 mode towed slip_ramp 0 0"),
              HasSubstr("keyword 'slip' changes over time in mode towed"));
  EXPECT_THAT(refusal_with("load_force 60 slip 0 slip_radius effective"),
              HasSubstr("keyword 'effective_radius' is missing with slip_radius effective"));
}

TEST(WheelRig, RefusesContradictionsWithKeywordAndRemedy) {
  EXPECT_THAT(refusal_of("speed 1 mode towed"),
              HasSubstr("fix wheel/rig has no load; allowed: exactly one of load_mass [kg], "
                        "load_force [N], sinkage [m]; "
                        "give the load that the ground carries, weight of the wheel included"));
  EXPECT_THAT(refusal_of("load_mass 5 load_force 60 speed 1 mode towed"),
              HasSubstr("has load_mass and load_force; allowed: exactly one"));
  EXPECT_THAT(refusal_of("load_mass 5 sinkage 0.1 speed 1 mode towed"),
              HasSubstr("has load_mass and sinkage"));
  EXPECT_THAT(refusal_of("load_force -60 speed 1 mode towed"),
              HasSubstr("keyword 'load_force' is -60; allowed: a number > 0 [N]"));
  EXPECT_THAT(refusal_of("load_mass 0 speed 1 mode towed"), HasSubstr("keyword 'load_mass' is 0"));
  EXPECT_THAT(refusal_of("load_force 60 speed -1 mode towed"),
              HasSubstr("keyword 'speed' is -1; allowed: a number in [0, 1000] [m/s]"));
  EXPECT_THAT(refusal_of("load_force 60 speed 1 mode skid"),
              HasSubstr("keyword 'mode' is 'skid'; allowed: one of: towed, slip, torque"));
  EXPECT_THAT(refusal_of("load_force 60 speed 0 mode slip slip 0.2"),
              HasSubstr("keyword 'speed' is 0 m/s in mode slip; allowed: a number > 0 [m/s]; give "
                        "a speed, or drive a "
                        "standing wheel with mode torque"));
  EXPECT_THAT(refusal_of("load_force 60 speed 1 mode slip"),
              HasSubstr("keyword 'slip' is missing in mode slip"));
  EXPECT_THAT(refusal_of("load_force 60 speed 1 mode towed slip 0.2"),
              HasSubstr("keyword 'slip' is given in mode towed; allowed: a slip in mode slip, and "
                        "only there; remove it or "
                        "change the mode"));
  EXPECT_THAT(refusal_of("load_force 60 speed 1 mode towed slip_definition rim_speed"),
              HasSubstr("keyword 'slip_definition' is given in mode towed"));
  EXPECT_THAT(refusal_of("load_force 60 speed 1 mode torque"),
              HasSubstr("keyword 'torque' is missing in mode torque"));
  EXPECT_THAT(refusal_of("load_force 60 speed 1 mode towed torque 5"),
              HasSubstr("keyword 'torque' is given in mode towed"));
  EXPECT_THAT(refusal_of("load_force 60 speed 1 mode slip slip 1"),
              HasSubstr("keyword 'slip' is 1 with slip_definition larger_speed; allowed: -1 to "
                        "below 1 by the larger speed"));
  EXPECT_THAT(refusal_of("load_force 60 speed 1 mode slip slip -1.2 slip_definition vehicle_speed"),
              HasSubstr("keyword 'slip' is -1.2 with slip_definition vehicle_speed"));
  EXPECT_THAT(
      refusal_of("load_force 60 speed 1 mode towed load_ramp_time 0.3"),
      HasSubstr("keyword 'load_ramp_time' is 0.3 s; allowed: 0 to settle_time, 0.2 s; lengthen "
                "settle_time"));
  EXPECT_THAT(refusal_of("sinkage 0.1 speed 1 mode towed load_ramp_time 0"),
              HasSubstr("keyword 'load_ramp_time' is 0 s with a prescribed sinkage"));
  EXPECT_THAT(refusal_of("load_force 60 speed 1 mode towed settle_time 0"),
              HasSubstr("keyword 'settle_time' is 0"));
  EXPECT_THAT(refusal_of("load_force 60 speed 1 mode towed slip_angle 90"),
              HasSubstr("keyword 'slip_angle' is 90"));
  EXPECT_THAT(refusal_of("load_force 60 speed 1 mode towed damping -1"),
              HasSubstr("keyword 'damping' is -1"));
  EXPECT_THAT(refusal_of("load_force 60 speed 1 mode towed camber 50"),
              HasSubstr("keyword 'camber' is 50"));
  EXPECT_THAT(refusal_of("load_force 60 speed 1 mode towed gravity 0"),
              HasSubstr("keyword 'gravity' is 0"));
}

}  // namespace
}  // namespace furrow::wheel_rig_test
