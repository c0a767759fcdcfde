// SPDX-License-Identifier: GPL-2.0-or-later
// Grains on a continuum, both renewed behind a body that flies over them and touches nothing: they
// must not notice. Grains and ground that come back are those that lay there at rest, so that
// nothing jumps, and the sheet bears the weight of the grains all the time.

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "atom.h"
#include "coupling/terrain/fix_terrain_continuum.h"
#include "modify.h"
#include "tests/coupled/support/sand.h"
#include "tests/support/max_error.h"

namespace furrow::test::moving_hybrid_test {
namespace {

constexpr double length = SandBed::length, step = SandBed::step, gravity = SandBed::gravity,
                 speed = 2.0;
constexpr int rest = 2000, rounds = 1, slabs = 8,  // and half a slab
    steps = static_cast<int>((rounds * length + 0.015) / speed / step);

/// A sheet far above the grains, which goes on along x once they are at rest.
std::unique_ptr<Body> kite() {
  Surface sheet = make_sheet(2, 0.04, 0.18);
  return std::make_unique<PrescribedBody>(sheet, [start = sheet.x](double time, Surface& surface) {
    surface.x = start;
    surface.x.row(0).array() += speed * std::max(0.0, time - rest * step);
    surface.v.setZero();
  });
}

/// Held by tangential springs on one patch of the sheet: sum of forces along its nodes [N].
double held_along(const Surface& sheet, std::size_t patch) {
  const Eigen::Index nodes = sheet.f.cols() / slabs;
  return sheet.f.middleCols(static_cast<Eigen::Index>(patch) * nodes, nodes)
      .topRows<2>()
      .colwise()
      .norm()
      .sum();
}

/// Where the ground is, and what it is like.
struct Ground {
  const char* name;
  const char* place;
  const char* walls;  ///< that it replaces
};

class MovingHybrid : public ::testing::TestWithParam<Ground> {};
INSTANTIATE_TEST_SUITE_P(
    Grounds, MovingHybrid,
    ::testing::Values(
        Ground{"layer", "cell 0.015 width 0.06 depth 0.03 surface 0", ""},
        Ground{"trough",
               "cell 0.01 width 0.1 depth 0.06 surface 0.03 trough 0.06 0.03 multirate yes",
               "unfix left\nunfix right"}),
    [](const auto& one) { return one.param.name; });

TEST_P(MovingHybrid, RenewedGroundKeepsGrainsAtRest) {
  Scene scene;
  make_sand_bed(scene, 0.03);
  scene.command("unfix floor");
  scene.commands(GetParam().walls);
  scene.add_body("kite", kite());
  const double grains = scene.sum(scene.lammps().atom->nlocal), mass = scene.grain_mass(),
               weight = mass * gravity;
  scene.command(
      fmt::format("fix soil all terrain/continuum material "
                  "{}/inputs/materials/rubber.yaml length {} centre 0.06 0 {} "
                  "surcharge {} "
                  "gravity {} surface_mesh yes follow kite slabs 8",
                  FURROW_SOURCE_DIR, length, GetParam().place, weight / (length * 0.06), gravity));
  scene.command("fix base all mesh/body body soil type 1");
  scene.command("fix skin all mesh/body body kite type 2");
  scene.command(
      fmt::format("fix wall all wall/gran/body {} mesh n_meshes 2 meshes base skin", hertz));
  scene.command(fmt::format("run {}", rest));

  auto& ground = static_cast<coupling::FixTerrainContinuum*>(
                     scene.lammps().modify->find_fix_id(const_cast<char*>("soil")))
                     ->terrain();
  const double particles = ground.particle_count();
  const Surface at_rest = ground.surface();
  scene.command("fix renew all bed/window body kite slabs 8 behind 0.06 terrain soil");
  MaxError kinetic_energy, off_weight;
  scene.at_end_of_step([&] {
    kinetic_energy.add(scene.grain_kinetic_energy());
    off_weight.add(-ground.surface().total_force().z() / weight - 1.0);
  });
  scene.command(fmt::format("run {}", steps));

  const double renewed = scene.lammps().modify->find_fix_id("renew")->compute_vector(0);
  // energy of the bed falling by a thousandth of a grain
  const double fall = mass * gravity * 0.001 * SandBed::diameter;
  EXPECT_EQ(renewed, slabs * rounds);
  EXPECT_EQ(ground.dropped_slabs(), static_cast<std::size_t>(slabs * rounds));
  EXPECT_NEAR(ground.travelled(), rounds * length, 1e-12);
  EXPECT_EQ(scene.sum(scene.lammps().atom->nlocal), grains);
  EXPECT_NEAR(scene.grain_mass() / mass, 1.0, 1e-12);
  EXPECT_EQ(ground.particle_count(), particles);
  EXPECT_LT(kinetic_energy.max(), fall);
  // Only the slab that stands still may bear other than its weight.
  EXPECT_LT(off_weight.max(), 1.0 / slabs);
  // Its grains lie on its patch as they did, and hold on to it as they did: 1.24 and 1.09 times as
  // much, but 0.04 and 0.61 where they lose their histories with the sheet.
  const std::size_t newest = (ground.dropped_slabs() - 1) % slabs;
  const double held = held_along(at_rest, newest);
  EXPECT_GT(held, 0.01 * weight / slabs);
  EXPECT_NEAR(held_along(ground.surface(), newest) / held, 1.0, 0.35);
  RecordProperty("held", fmt::to_string(held_along(ground.surface(), newest) / held));
  RecordProperty("off_weight", fmt::to_string(off_weight.max()));
  const coupling::MomentumAudit& audit = scene.system().audit(ground);
  EXPECT_LT(audit.force, 1e-10);
  EXPECT_LT(audit.moment, 1e-10);
}

}  // namespace
}  // namespace furrow::test::moving_hybrid_test
