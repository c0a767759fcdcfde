// SPDX-License-Identifier: GPL-2.0-or-later
// Tyres that roll on a rigid plane, driven by the rig: the shells of [Shoop2001] failed near one
// turn. References: conservation of energy, the inextensible belt's rolling radius, the load,
// statics of a driven wheel.

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../../unit/tyre/tyres.h"
#include "furrow/io/inputs/brick_tyre_file.h"
#include "furrow/rig/wheel_rig.h"
#include "tests/support/max_error.h"
#include "tests/support/words.h"
#include "furrow/tyre/brick/brick_tyre.h"
#include "furrow/tyre/darnell/darnell_tyre.h"

namespace furrow::rolling_test {
namespace {

struct Outcome {
  double turns, rolling_radius, force_x, force_z, worst_energy, energy_scale, deflection,
      damping_power;
};

const HubParameters rim = {{30.0, 1.0, 0.6}, {0.0, 0.0, 0.4}};

/// 4 x 36, half model.
DarnellTyre darnell() {
  DarnellTyreSettings settings = coarse(true);
  settings.sidewall_rows = 0;
  return {read_tyre_file(FURROW_SOURCE_DIR "/inputs/tyres/p235_75r15.yaml"), settings, rim};
}

/// 24 sections, half model.
BrickTyre bricks() {
  BrickTyreSettings settings;
  settings.sections = 24;
  settings.half = true;
  return {read_brick_tyre_file(FURROW_SOURCE_DIR "/inputs/tyres/p235_75r15_smooth.yaml"), settings,
          rim};
}

/// On a plane with friction; means over the last turn.
Outcome roll(Tyre& tyre, const std::string& mode, double value, double speed, double time) {
  tyre.settle(nullptr);
  RigidPlaneParameters road;
  road.height = tyre.lowest_tread_height() - 1e-4;
  road.friction = 0.8;
  RigidPlane plane(road, tyre.surface());
  std::string options = fmt::format(
      "load_force 6227 speed {} mode {} settle_time 0.25 accelerate_time 0.25 ground_level {} "
      "damping 3000",
      speed, mode, road.height);
  if (mode != "towed") options += fmt::format(" {} {}", mode == "slip" ? "slip" : "torque", value);
  WheelRig rig(WheelRig::schema().read(test::words(options)), tyre);
  const double dt = 0.9 * tyre.stable_time_step(), start = tyre.energy_budget().residual(),
               average_from = time - 2.0 * pi * 0.3475 / speed;
  Outcome run{};
  test::MaxError energy;
  double from_x = 0.0, from_spin = 0.0, from_damped = 0.0, counted = 0.0;
  const long steps = std::lround(time / dt);
  for (long i = 0; i < steps; ++i) {
    rig.apply(static_cast<double>(i) * dt, dt);
    tyre.surface().clear_forces();
    plane.press_on(tyre.surface());
    const Vector3 force = tyre.ground_wrench().force;
    tyre.advance(dt);
    const EnergyBudget budget = tyre.energy_budget();
    energy.add(budget.residual() - start);
    run.energy_scale =
        std::max({run.energy_scale, budget.kinetic_energy, std::abs(budget.load_work)});
    if (static_cast<double>(i) * dt < average_from) continue;
    if (counted == 0.0)
      from_x = tyre.centre().x(), from_spin = tyre.position(Coordinate::spin),
      from_damped = budget.dissipated_energy;
    run.force_x += force.x() * dt;
    run.force_z += force.z() * dt;
    run.deflection += (tyre.nominal_radius() - (tyre.centre().z() - road.height)) * dt;
    counted += dt;
  }
  run.worst_energy = energy.max();
  run.force_x /= counted;
  run.force_z /= counted;
  run.deflection /= counted;
  run.damping_power = (tyre.energy_budget().dissipated_energy - from_damped) / counted;
  run.turns = tyre.position(Coordinate::spin) / (2.0 * pi);
  run.rolling_radius = (tyre.centre().x() - from_x) / (tyre.position(Coordinate::spin) - from_spin);
  return run;
}

/// @param least, largest [m] of the rolling radius
void expect_many_turns(Tyre& tyre, double least, double largest) {
  const Outcome run = roll(tyre, "towed", 0.0, 6.0, 2.4);
  testing::Test::RecordProperty(
      "roll", fmt::format("{:.1f} turns, rolling radius {:.4f} m, drag {:.1f} N, load {:.1f} N, "
                          "damping takes {:.1f} W, energy off by {:.1e} of {:.0f} J",
                          run.turns, run.rolling_radius, -run.force_x, run.force_z,
                          run.damping_power, run.worst_energy, run.energy_scale));
  EXPECT_GT(run.turns, 5.0);
  EXPECT_NEAR(run.force_z, 6227.0, 0.005 * 6227.0);
  EXPECT_LT(run.worst_energy, 1e-3 * run.energy_scale);
  EXPECT_GT(run.rolling_radius, least);
  EXPECT_LT(run.rolling_radius, largest);
  EXPECT_GT(run.deflection, 0.02);
  // The damping turns the work of the drag into heat (free spin, steady).
  EXPECT_NEAR(-run.force_x * 6.0 / run.damping_power, 1.0, 0.25);
}

TEST(RollingTyre, ShellTyreKeepsEnergyOverManyTurns) {
  DarnellTyre tyre = darnell();
  // The belt hardly stretches: in a turn it lays down its own length, not that of the loaded
  // radius.
  expect_many_turns(tyre, 0.3475 - 0.004, 0.3475 + 0.004);
}

TEST(RollingTyre, BrickTyreKeepsEnergyOverManyTurns) {
  BrickTyre tyre = bricks();
  // Between its inflated belts and the outside of its tread, which 24 sections hardly flatten
  expect_many_turns(tyre, 0.3520, 0.3730);
}

TEST(RollingTyre, SlipGivesPullAndBraking) {
  DarnellTyre driven = darnell(), braked = darnell();
  const Outcome drive = roll(driven, "slip", 0.02, 2.0, 1.6);
  const Outcome brake = roll(braked, "slip", -0.02, 2.0, 1.6);
  RecordProperty("force_at_2_percent",
                 fmt::format("{:.0f} N, braking {:.0f} N", drive.force_x, brake.force_x));
  EXPECT_GT(drive.force_x, 300.0);
  EXPECT_LT(brake.force_x, -300.0);
  EXPECT_LT(drive.force_x, 0.8 * 6300.0);  // Coulomb's limit
  EXPECT_GT(brake.force_x, -0.8 * 6300.0);
}

}  // namespace
}  // namespace furrow::rolling_test
