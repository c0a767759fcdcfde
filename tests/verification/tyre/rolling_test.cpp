// SPDX-License-Identifier: GPL-2.0-or-later
// A tyre that rolls on a rigid plane, driven by the rig: the shells of [Shoop2001] failed near one
// turn. References: conservation of energy, the inextensible belt's rolling radius, the load,
// statics of a driven wheel.

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/tyre_file.h"
#include "rig/wheel_rig.h"
#include "tests/support/max_error.h"
#include "tyre/contact_patch.h"
#include "tyre/darnell_tyre.h"

namespace furrow {
namespace {

struct Outcome {
  double turns, rolling_radius, force_x, force_z, worst_energy, energy_scale, deflection,
      damping_power;
};

/// 4 x 36, half model, on a plane with friction; means over the last turn.
Outcome roll(const std::string& mode, double value, double speed, double time) {
  TyreParameters parameters =
      read_tyre_file(std::string(FURROW_SOURCE_DIR) + "/inputs/tyres/p235_75r15.yaml");
  DarnellTyreSettings settings;
  settings.across = 4;
  settings.around = 36;
  settings.half = true;
  settings.sidewall_rows = 0;
  DarnellTyre tyre(parameters, settings, {{30.0, 1.0, 0.6}, {0.0, 0.0, 0.4}});
  tyre.settle(nullptr);
  RigidPlaneParameters road;
  road.height = tyre.tread().x.row(2).minCoeff() - 1e-4;
  road.friction = 0.8;
  RigidPlane plane(road, tyre.surface());
  std::vector<std::string> words{"load_force",
                                 "6227",
                                 "speed",
                                 fmt::to_string(speed),
                                 "mode",
                                 mode,
                                 "settle_time",
                                 "0.25",
                                 "accelerate_time",
                                 "0.25",
                                 "ground_level",
                                 fmt::to_string(road.height),
                                 "damping",
                                 "3000"};
  if (!mode.empty() && mode != "towed")
    words.insert(words.end(), {mode == "slip" ? "slip" : "torque", fmt::to_string(value)});
  WheelRig rig(WheelRig::schema().read(words), tyre);
  const double dt = tyre.stable_time_step(), start = tyre.energy_budget().residual(),
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

TEST(RollingTyre, ManyTurns) {
  const Outcome run = roll("towed", 0.0, 6.0, 2.4);
  RecordProperty("roll",
                 fmt::format("{:.1f} turns, rolling radius {:.4f} m, drag {:.1f} N, load {:.1f} N, "
                             "damping takes {:.1f} W, energy off by {:.1e} of {:.0f} J",
                             run.turns, run.rolling_radius, -run.force_x, run.force_z,
                             run.damping_power, run.worst_energy, run.energy_scale));
  EXPECT_GT(run.turns, 5.0);
  EXPECT_NEAR(run.force_z, 6227.0, 0.005 * 6227.0);
  EXPECT_LT(run.worst_energy, 1e-3 * run.energy_scale);
  // The belt hardly stretches: in a turn it lays down its own length, not that of the loaded
  // radius.
  EXPECT_NEAR(run.rolling_radius, 0.3475, 0.004);
  EXPECT_GT(run.deflection, 0.02);
  // What the drag takes, the damping turns into heat (free spin, steady).
  EXPECT_NEAR(-run.force_x * 6.0 / run.damping_power, 1.0, 0.25);
}

TEST(RollingTyre, SlipPullsAndBrakes) {
  const Outcome drive = roll("slip", 0.02, 2.0, 1.6), brake = roll("slip", -0.02, 2.0, 1.6);
  RecordProperty("force_at_2_percent",
                 fmt::format("{:.0f} N, braking {:.0f} N", drive.force_x, brake.force_x));
  EXPECT_GT(drive.force_x, 300.0);
  EXPECT_LT(brake.force_x, -300.0);
  EXPECT_LT(drive.force_x, 0.8 * 6300.0);  // Coulomb's limit
  EXPECT_GT(brake.force_x, -0.8 * 6300.0);
}

}  // namespace
}  // namespace furrow
