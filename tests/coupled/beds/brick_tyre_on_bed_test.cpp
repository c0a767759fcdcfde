// SPDX-License-Identifier: GPL-2.0-or-later
// A ribbed tyre with a tread of bricks on a layer of grains finer than its grooves, on one and two
// ranks: forces on nodes and grains cancel in every step, and grains take what the tyre gives
// (impulse theorem).

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "coupling/wheels/fix_tyre_brick.h"
#include "modify.h"
#include "tests/coupled/support/scene.h"

namespace furrow::test::brick_tyre_on_bed_test {
namespace {

constexpr double load = 1500.0, dt = 1e-5;  // [N], [s]

TEST(BrickTyreOnBed, GrainsInGroovesKeepMomentum) {
  Scene scene;
  scene.granular_box(Vector3(-0.5, -0.3, -0.01), Vector3(0.5, 0.3, 1.0), 0.004);
  scene.contact_properties(1e7, 0.3, 0.3, 0.6);
  constexpr const char* hertz = "model hertz tangential history";
  scene.commands(fmt::format(
      "pair_style gran {0}\npair_coeff * *\ntimestep {1}\n"
      "lattice sc 0.012\nregion layer block -0.06 0.0599 -0.096 0.0959 0 0.0119 units box\n"
      "create_atoms 1 region layer\nset group all diameter 0.0115 density 2500\n"
      "displace_atoms all move 0 0 0.00575 units box\n"
      "fix weight all gravity 9.81 vector 0 0 -1\n"
      "fix floor all wall/gran {0} primitive type 1 zplane 0\nfix move all nve/sphere",
      hertz, dt));
  scene.command(fmt::format(
      "fix tyre all tyre/brick file {}/inputs/tyres/p235_75r15_ribbed.yaml pressure 1e5 "
      "sections 16 mass 20 inertia 0.6 axle 0 0 0.3816",
      FURROW_SOURCE_DIR));
  scene.command(fmt::format(
      "fix rig all wheel/rig wheel tyre load_force {} speed 0.4 mode towed settle_time 0.3 "
      "load_ramp_time 0.001 accelerate_time 0.1 ground_level 0.0115 damping 0 release in_air",
      load));
  scene.wall_of_body("tyre", hertz, "tread");
  BrickTyre& tyre =
      dynamic_cast<coupling::FixTyreBrick*>(scene.lammps().modify->find_fix_id("tyre"))->tyre();
  double impulse = 0.0, time = 0.0;
  bool counting = false;
  scene.at_end_of_step([&] {
    if (!counting) return;
    impulse += dt * tyre.surface().total_force().z();
    time += dt;
  });
  scene.command("run 300");  // the load is on
  const double momentum = tyre.energy_budget().momentum.z();
  counting = true;
  scene.command("run 1200");
  // Velocities and forces belong to half a step apart: the sums are those of steps shifted by one.
  const double expected = load * time + tyre.energy_budget().momentum.z() - momentum;
  EXPECT_NEAR(impulse / expected, 1.0, 1e-2);
  const coupling::MomentumAudit& audit = scene.system().audit(tyre);
  EXPECT_GT(audit.force_scale, 0.1 * load);  // still sinking in
  EXPECT_LT(audit.force, 1e-10);
  EXPECT_LT(audit.moment, 1e-10);
}

}  // namespace
}  // namespace furrow::test::brick_tyre_on_bed_test
