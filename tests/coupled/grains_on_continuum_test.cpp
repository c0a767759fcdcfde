// SPDX-License-Identifier: GPL-2.0-or-later
// The hybrid: grains that lie on continuum ground. The sheet on top of the ground is one more mesh
// wall; the laws of motion are the reference: what grains and ground gain in momentum is what
// gravity and the base give them, to rounding.

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "coupling/terrain/fix_terrain_continuum.h"
#include "modify.h"
#include "tests/coupled/support/scene.h"
#include "update.h"

namespace furrow::test::grains_on_continuum_test {
namespace {

constexpr double gravity = 9.81, side = 0.08, step = 1e-5;
constexpr const char* hertz = "model hertz tangential history";

/// Further keywords of the ground.
class GrainsOnContinuum : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Sheets, GrainsOnContinuum,
                         ::testing::Values("", " multirate yes surface_mesh_every 2 surcharge 200",
                                           " trough 0.04 0.01"));

TEST_P(GrainsOnContinuum, BaseCarriesTheWeightOfTheGrains) {
  Scene scene;
  scene.granular_box(Vector3(-0.041, -0.041, -0.01), Vector3(0.041, 0.041, 0.15), 0.002);
  scene.contact_properties(5e6, 0.3, 0.5, 0.0);  // walls without friction carry no weight
  scene.grains_fall(hertz, step, gravity);
  scene.command(
      fmt::format("fix soil all terrain/continuum material {}/inputs/materials/rubber.yaml length "
                  "{} width {} depth 0.03 "
                  "surface 0.03 cell 0.01 "
                  "gravity {} surface_mesh yes{}",
                  FURROW_SOURCE_DIR, side, side, gravity, GetParam()));
  scene.wall_of_body("soil", hertz, "top");
  scene.flat_walls(hertz, {"xplane -0.04", "xplane 0.04", "yplane -0.04", "yplane 0.04"});
  scene.pour(0.005, "block -0.04 0.04 -0.04 0.04 0.035 0.1", "particles_in_region 120");
  scene.commands("fix calm all viscous 0.03\nthermo 100000\nrun 15000\nunfix calm");

  auto& ground = static_cast<coupling::FixTerrainContinuum*>(
                     scene.lammps().modify->find_fix_id(const_cast<char*>("soil")))
                     ->terrain();
  const double before = scene.upward_momentum();
  const Vector3 ground_before = ground.energy_budget().momentum,
                base_before = ground.boundary_impulse(Face::z_lower);
  double impulse = 0.0;
  scene.at_end_of_step([&] { impulse += ground.surface().total_force().z() * step; });
  constexpr int steps = 2000;
  scene.command(fmt::format("run {}", steps));

  // The sheet's forces are the grains': their momentum and weight (the wall acts one step ahead of
  // the ground's).
  const double weight = scene.grain_mass() * gravity, time = steps * step;
  EXPECT_GT(weight, 1.0);
  const double grains_gain = scene.upward_momentum() - before;
  EXPECT_NEAR(-impulse, weight * time + grains_gain, 1e-3 * weight * time);
  // The impulse of the base carries the ground, its grains and their change of momentum.
  double mass = 0.0;
  for (const ParticleGroup& phase : ground.unsynchronised_groups())
    for (std::size_t p = 0; p < phase.particles.size(); ++p)
      mass += phase.material->density() * phase.particles.data(column::volume)[p];
  mass = scene.sum(mass);
  const double base = ground.boundary_impulse(Face::z_lower).z() - base_before.z(),
               ground_gain = ground.energy_budget().momentum.z() - ground_before.z();
  // forces are one step older in the ground
  EXPECT_NEAR(base, mass * gravity * time + ground_gain - impulse, 2e-3 * base);
  // Work that the grains lose to the sheet is found in contacts and ground.
  const coupling::ContactWork& work = scene.system().contact_work(ground);
  const double given = -(work.press + work.push + work.friction + work.contact);
  EXPECT_GT(given, 1e-4);
  EXPECT_NEAR(ground.energy_budget().contact_work, given, 5e-3 * std::abs(work.press));
  const coupling::MomentumAudit& audit = scene.system().audit(ground);
  EXPECT_GT(audit.force_scale, 0.0);
  EXPECT_LT(audit.force, 1e-10);
  EXPECT_LT(audit.moment, 1e-10);
}

}  // namespace
}  // namespace furrow::test::grains_on_continuum_test
