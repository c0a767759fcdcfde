// SPDX-License-Identifier: GPL-2.0-or-later
// A small wheel on a small bed: conservation laws of the coupled system. The load is carried
// (statics), the wheel's energy balance closes to round-off, forces on nodes and grains cancel in
// every step, and slip is what was asked for.

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "coupling/drive/fix_wheel_rig.h"
#include "coupling/wheels/fix_wheel_rigid.h"
#include "modify.h"
#include "tests/coupled/support/scene.h"
#include "tests/support/max_error.h"
#include "update.h"

namespace furrow::test::wheel_on_bed_test {
namespace {

constexpr const char* hertz = "model hertz tangential history";
constexpr double load = 8.0, wheel_mass = 0.5, damping = 10.0;

/// 700 grains of 8 mm in a box 0.24 x 0.1 m, poured and come to rest.
void make_bed(Scene& scene) {
  scene.granular_box(Vector3(-0.13, -0.06, -0.01), Vector3(0.13, 0.06, 0.25), 0.003);
  scene.contact_properties(5e6, 0.3, 0.3, 0.5);
  scene.grains_fall(hertz, 4e-5);
  scene.flat_walls(hertz,
                   {"xplane -0.12", "xplane 0.12", "yplane -0.05", "yplane 0.05", "zplane 0"});
  scene.pour(0.004, "block -0.12 0.12 -0.05 0.05 0 0.12", "particles_in_region 1500");
  scene.commands("fix calm all viscous 0.02\nthermo 100000\nrun 12000\nunfix calm");
}

struct Outcome {
  double standing_force;  // mean vertical force while standing [N]
  // load, and what the wheel's momentum and the rig's damping took up in that time [N]
  double expected_force;
  double worst_slip_error;
  double energy_residual, energy_scale;
  double works_residual;  // wheel's work less what friction, grains and contacts had of it [J]
  double force_scale;     // [N] of the contacts, in the step in which it was largest
  double force_defect, moment_defect;
};

Outcome roll(Scene& scene, double slip) {
  make_bed(scene);
  const double level = scene.top_of_grains();
  scene.command(
      fmt::format("fix wheel all wheel/rigid diameter 0.1 width 0.05 shoulder 0.005 mass 0.5 "
                  "inertia 6e-4 segments 48 axle "
                  "-0.05 0 {:.9f}",
                  level + 0.052));
  scene.command(
      fmt::format("fix rig all wheel/rig wheel wheel load_force {} speed 0.2 mode slip slip {} "
                  "settle_time 0.4 load_ramp_time 0.1 "
                  "accelerate_time 0.1 ground_level {:.9f} damping 10 release in_air",
                  load, slip, level));
  scene.wall_of_body("wheel", hertz, "tread");
  const coupling::FixWheelRig& rig =
      *dynamic_cast<coupling::FixWheelRig*>(scene.lammps().modify->find_fix_id("rig"));
  const RigidWheel& wheel =
      dynamic_cast<coupling::FixWheelRigid*>(scene.lammps().modify->find_fix_id("wheel"))->wheel();

  Outcome run{};
  MaxError slip_error;
  // Impulse theorem over the last part of the settling: sum of F dt = load T + m change of v + c
  // change of z, exact for the leapfrog (the velocity at the end of a step does not yet know the
  // force of that step).
  double sum = 0.0, first_velocity = 0.0, first_height = 0.0, last_velocity = 0.0,
         last_height = 0.0;
  int samples = 0;
  scene.at_end_of_step([&] {
    const double time = scene.system().time();
    last_velocity = time < 0.39 ? wheel.velocity()[2] : last_velocity;
    last_height = time < 0.39 ? wheel.centre()[2] : last_height;
    if (time > 0.3 && time + scene.lammps().update->dt < 0.39) {
      if (samples++ == 0) {
        first_velocity = wheel.velocity()[2];
        first_height = wheel.centre()[2];
      }
      sum += wheel.surface().total_force()[2];
    }
    if (rig.rig().stage(time) == RigStage::cruise) {
      const double rim = wheel.rate(Coordinate::spin) * wheel.parameters().geometry.radius(),
                   v = wheel.velocity()[0];
      slip_error.add((rim - v) / std::max(std::abs(rim), std::abs(v)) - slip);
    }
  });
  scene.command("run 17500");
  const double duration = samples * scene.lammps().update->dt;
  run.worst_slip_error = slip_error.max();
  run.standing_force = sum / samples;
  run.expected_force = load + (wheel_mass * (last_velocity - first_velocity) +
                               damping * (last_height - first_height)) /
                                  duration;
  const EnergyBudget budget = wheel.energy_budget();
  run.energy_residual = std::abs(budget.residual());
  run.energy_scale = std::max(std::abs(budget.contact_work), std::abs(budget.load_work));
  const coupling::ContactWork& work = scene.system().contact_work(wheel);
  EXPECT_GT(work.friction, 0.0);
  EXPECT_GT(work.press, 0.0);
  run.works_residual =
      std::abs(-budget.contact_work - (work.press + work.push + work.friction + work.contact));
  testing::Test::RecordProperty("works_residual",
                                fmt::format("{:.3g}", run.works_residual / run.energy_scale));
  run.force_scale = scene.system().audit(wheel).force_scale;
  run.force_defect = scene.system().audit(wheel).force;
  run.moment_defect = scene.system().audit(wheel).moment;
  return run;
}

TEST(WheelOnBed, WheelCarriesItsLoadAndKeepsMomentumAndEnergy) {
  Scene scene;
  const Outcome run = roll(scene, 0.2);
  EXPECT_NEAR(run.standing_force / run.expected_force, 1.0, 1e-6);
  EXPECT_NEAR(run.standing_force / load, 1.0, 0.02);  // it stands, nearly
  EXPECT_LT(run.worst_slip_error, 1e-10);
  EXPECT_LT(run.energy_residual / run.energy_scale, 1e-10);
  EXPECT_LT(run.works_residual / run.energy_scale, 0.01);
  EXPECT_GT(run.force_scale, 0.5 * load);
  EXPECT_LT(run.force_defect, 1e-10);
  EXPECT_LT(run.moment_defect, 1e-10);
}

}  // namespace
}  // namespace furrow::test::wheel_on_bed_test
