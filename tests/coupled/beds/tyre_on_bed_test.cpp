// SPDX-License-Identifier: GPL-2.0-or-later
// A deforming tyre on grains, on one and two ranks: forces on nodes and grains cancel in every
// step, the load is carried (impulse theorem), the tyre's energy balance closes, and it rolls.

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "coupling/wheels/fix_tyre_darnell.h"
#include "coupling/drive/fix_wheel_rig.h"
#include "modify.h"
#include "tests/coupled/support/scene.h"
#include "tests/support/max_error.h"
#include "update.h"

namespace furrow::test::tyre_on_bed_test {
namespace {

constexpr const char* hertz = "model hertz tangential history";
constexpr double load = 1500.0, dt = 5e-5, damping = 500.0;

/// Grains of 30 mm, frictional, in a box of 0.8 x 0.32 m, poured and come to rest.
void make_bed(Scene& scene) {
  scene.granular_box(Vector3(-0.45, -0.25, -0.02), Vector3(0.45, 0.25, 0.95), 0.008);
  scene.contact_properties(1e7, 0.3, 0.3, 0.6);
  scene.grains_fall(hertz, dt);
  scene.flat_walls(hertz, {"xplane -0.4", "xplane 0.4", "yplane -0.16", "yplane 0.16", "zplane 0"});
  scene.pour(0.015, "block -0.4 0.4 -0.16 0.16 0 0.25", "particles_in_region 1300");
  scene.commands("fix calm all viscous 0.5\nthermo 100000\nrun 8000\nunfix calm");
}

TEST(TyreOnBed, RollingTyreKeepsMomentumAndEnergy) {
  Scene scene;
  make_bed(scene);
  const double level = scene.top_of_grains();
  scene.command(
      fmt::format("fix tyre all tyre/darnell file {}/inputs/tyres/p235_75r15.yaml pressure 4e4 "
                  "mesh 4 36 mass 20 inertia 0.6 "
                  "axle -0.05 0 {:.9f}",
                  FURROW_SOURCE_DIR, level + 0.3495));
  scene.command(
      fmt::format("fix rig all wheel/rig wheel tyre load_force {} speed 0.4 mode towed settle_time "
                  "0.3 load_ramp_time 0.15 "
                  "accelerate_time 0.1 ground_level {:.9f} damping {} release in_air",
                  load, level, damping));
  scene.wall_of_body("tyre", hertz, "tread");
  DarnellTyre& tyre =
      dynamic_cast<coupling::FixTyreDarnell*>(scene.lammps().modify->find_fix_id("tyre"))->tyre();

  // Impulse theorem over part of the settling: sum of F dt = load T + change of momentum + damping
  // x change of height
  double impulse = 0.0, time = 0.0, scale = 0.0, deflection = 0.0;
  const double energy_at_start = tyre.energy_budget().residual();
  MaxError energy;
  bool counting = false;
  scene.at_end_of_step([&] {
    const EnergyBudget budget = tyre.energy_budget();
    energy.add(budget.residual() - energy_at_start);
    scale = std::max(
        {scale, std::abs(budget.load_work), std::abs(budget.contact_work), budget.kinetic_energy});
    deflection = std::max(deflection, tyre.tread().x.row(2).minCoeff() - tyre.lowest_point());
    if (!counting) return;
    impulse += dt * tyre.surface().total_force().z();
    time += dt;
  });
  scene.command("run 4000");
  const double momentum = tyre.energy_budget().momentum.z(), height = tyre.centre().z();
  counting = true;
  scene.command("run 1800");
  counting = false;
  // Velocities and forces belong to half a step apart: the sums are those of steps shifted by one.
  const double expected = load * time + tyre.energy_budget().momentum.z() - momentum +
                          damping * (tyre.centre().z() - height);
  EXPECT_NEAR(impulse / expected, 1.0, 2e-3);

  scene.command("run 6000");  // accelerates and rolls 8 cm
  EXPECT_GT(tyre.centre().x(), 0.0);
  EXPECT_GT(tyre.position(Coordinate::spin), 0.1);
  EXPECT_GT(deflection, 0.01);
  EXPECT_LT(energy.max(), 2e-3 * scale);
  const coupling::MomentumAudit& audit = scene.system().audit(tyre);
  EXPECT_GT(audit.force_scale, 0.5 * load);
  EXPECT_LT(audit.force, 1e-10);
  EXPECT_LT(audit.moment, 1e-10);
}

}  // namespace
}  // namespace furrow::test::tyre_on_bed_test
