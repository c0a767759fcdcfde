// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/continuum_terrain.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "terrain_scene.h"
#include "tests/support/checkpoints.h"
#include "tests/support/error_of.h"

namespace furrow::continuum_terrain_test {
namespace {

using ::testing::HasSubstr;
using namespace testing_terrain;

constexpr double cell = 0.025, depth = 0.1;

TerrainParameters snow_bed(const std::string& material = snow()) {
  TerrainParameters parameters =
      box(material_of(material), {-0.1, -0.1, 0}, {0.1, 0.1, depth}, cell);
  parameters.z = even(0, depth + 2 * cell, cell);
  parameters.gravity = {0, 0, -standard_gravity};
  parameters.initial_stress = true;
  set_boundary(parameters, {"absorbing", "smooth", "smooth", "absorbing", "rough", "free"});
  return parameters;
}

/// A plate that is pushed into a bed, with all that a restart must carry: friction, absorbing
/// faces, sorting.
struct Scene : PressedGround {
  explicit Scene(const TerrainParameters& parameters)
      : PressedGround(parameters, {PlateShape::square, 0.1, 0.05, 4}, {0, 0, depth + 1e-4}) {}
  void run(int intervals) {
    for (int n = 0; n < intervals; ++n) {
      plate.prescribe(-1.0);
      system.advance(2e-4);
    }
  }
};

template <class Part>
void expect_same_state(Part& a, Part& b) {
  EXPECT_TRUE(test::state_of(a) == test::state_of(b));
}

void expect_exact_restart(const TerrainParameters& parameters) {
  Scene through(parameters);
  through.touch();
  through.run(40);
  Scene again(parameters);
  restart(through, again);
  expect_same_state(through.ground, again.ground);
  // the first output of the continued run
  EXPECT_GT(through.contact->force().z(), 0.0);
  EXPECT_EQ(through.contact->force(), again.contact->force());
  EXPECT_EQ(through.contact->contacts(), again.contact->contacts());
  EXPECT_EQ(through.contact->area(), again.contact->area());
  EXPECT_EQ(through.contact->penetration(), again.contact->penetration());
  through.run(50);
  again.run(50);
  EXPECT_GT(through.contact->contacts(), 10.0);
  expect_same_state(through.ground, again.ground);
  expect_same_state(*through.contact, *again.contact);
  EXPECT_EQ(through.contact->force(), again.contact->force());
}

TEST(TerrainRestart, ContinuesBitForBit) { expect_exact_restart(snow_bed()); }

std::string clay() {
  return "undrained_clay density 1800 su 2e4 sensitivity 3 slip_95 0.03 rate_share 0.1 elasticity "
         "linear E 2e6 nu 0.45";
}

TEST(TerrainRestart, ContinuesBitForBitOnSensitiveClay) { expect_exact_restart(snow_bed(clay())); }

/// A shear band is as wide as the cell of its particle, the cube root of the volume of a long cell.
TEST(ContinuumTerrain, ShearBandOfClayHasTheCellSizeOfItsParticle) {
  TerrainParameters parameters = snow_bed(clay());
  parameters.x = {-0.2, 0.2, cell, -0.1, 0.1, 1.2};
  ContinuumTerrain ground(parameters, Communicator());
  const std::size_t width = *parameters.layers[0].material->find_field("band_width");
  double shortest = 1.0, longest = 0.0;
  for_particles(ground, [&](Particles& particles, std::size_t p) {
    const double x = particles.data(column::x)[p], found = particles.data(column::state + width)[p];
    if (std::abs(x) < 0.1 - cell) {
      EXPECT_NEAR(found, cell, 1e-12);
    }
    shortest = std::min(shortest, found);
    longest = std::max(longest, found);
  });
  EXPECT_NEAR(shortest, cell, 1e-12);
  EXPECT_GT(longest, 1.05 * cell);
}

TEST(TerrainRestart, ContinuesBitForBitOnAGradedGrid) {
  TerrainParameters parameters = snow_bed();
  parameters.x = {-0.2, 0.2, cell, -0.1, 0.1, 1.2};
  expect_exact_restart(parameters);
}

/// A window on a graded axis, which divides and unites particles before the restart and after it.
TEST(TerrainRestart, ContinuesBitForBitOnAGradedWindow) {
  TerrainParameters parameters = snow_bed(clay());
  set_boundary(parameters, {"smooth", "smooth", "smooth", "smooth", "rough", "free"});
  const FollowingAxis axis = following_axis({-0.6, 0.6, cell, -0.1, 0.1, 1.3}, "ground");
  parameters.x = axis.layout;
  parameters.halvings = axis.halvings;
  parameters.window = true;
  Scene through(parameters);
  through.touch();
  const auto run = [](Scene& scene, int from, int to) {
    for (int n = from; n < to; ++n) {
      scene.ground.follow(0.01 * n);
      scene.run(1);
    }
  };
  run(through, 0, 20);
  Scene again(parameters);
  restart(through, again);
  expect_same_state(through.ground, again.ground);
  EXPECT_GT(through.contact->contacts(), 10.0);
  const double travelled = through.ground.travelled();
  EXPECT_GT(travelled, 0.0);
  run(through, 20, 50);
  run(again, 20, 50);
  EXPECT_GT(through.ground.travelled(), travelled);
  expect_same_state(through.ground, again.ground);
  expect_same_state(*through.contact, *again.contact);
}

/// Porous elasticity: the stiffness of the contact follows the modulus.
TEST(TerrainRestart, ContinuesBitForBitWithPorousElasticity) {
  expect_exact_restart(
      snow_bed("crushable_foam density 200 pt 2000 sigma0 5000 K 1 pc0_reading pc0 elasticity "
               "porous elasticity.kappa 0.005 "
               "elasticity.e0 3.5 nu 0.3 "
               "pt_el 5000 hardening exponential pc0 5000 lambda 0.35 hardening.kappa 0.005 "
               "hardening.e0 3.5"));
}

TEST(TerrainRestart, ErrorNamesTheDifferingKeyOfTheLaw) {
  TerrainParameters parameters = snow_bed();
  parameters.layers[0].description = {{"law", {"drucker_prager_cap"}}, {"law.d", {"5e3"}}};
  ContinuumTerrain ground(parameters, Communicator());
  parameters.layers[0].description[1].values = {"30e3"};
  ContinuumTerrain other(parameters, Communicator());
  EXPECT_THAT(test::error_of<Error>([&] { test::hand_over(ground, other); }),
              HasSubstr("'law.d' of a layer is '30e3', and was '5e3' when"));
}

TEST(TerrainRestart, RefusesTheStateOfOtherGround) {
  ContinuumTerrain ground(snow_bed(), Communicator());
  TerrainParameters other = snow_bed();
  other.x = even(-0.1, 0.2, cell);
  ContinuumTerrain wider(other, Communicator());
  EXPECT_THAT(test::error_of<Error>([&] { test::hand_over(ground, wider); }),
              HasSubstr("cells is 12, and was 8 when the checkpoint was written"));
}

/// Ground that follows a wheel: fresh ground ahead, what is behind is dropped and leaves its
/// profile; nothing moves by that.
TEST(MovingTerrain, WindowDropsGroundBehindAndAddsGroundAhead) {
  TerrainParameters parameters = snow_bed();
  set_boundary(parameters, {"smooth", "smooth", "smooth", "smooth", "rough", "free"});
  parameters.window = true;
  ContinuumTerrain ground(parameters, Communicator());
  const double particles = ground.particle_count(), mass = sums_of(ground).mass;
  ground.advance(1e-5);
  ground.follow(0.3);
  // at the end of a remap interval
  for (int step = 0; step < parameters.remap_interval; ++step) ground.advance(1e-5);
  // by whole cells, one behind what it follows
  EXPECT_NEAR(ground.travelled(), 0.275, 1e-12);
  EXPECT_EQ(ground.particle_count(), particles);
  EXPECT_NEAR(sums_of(ground).mass / mass, 1.0, 1e-12);
  EXPECT_NEAR(sums_of(ground).centre.x(), 0.275, 1e-6);
  // columns dropped times cells across, the new ones of the gap included
  ASSERT_EQ(ground.rut().points().size(), 11u * 8u);
  for (const RutPoint& point : ground.rut().points()) {
    EXPECT_NEAR(point.z, depth, 1e-3);
    EXPECT_NEAR(point.density, 200.0, 1.0);
    EXPECT_LT(point.x, 0.275 - 0.1);
  }
  std::vector<double> ids;
  for_particles(ground, [&](Particles& p, std::size_t n) { ids.push_back(p.data(column::id)[n]); });
  std::sort(ids.begin(), ids.end());
  EXPECT_EQ(std::unique(ids.begin(), ids.end()), ids.end());
  const EnergyBudget budget = ground.energy_budget();
  EXPECT_NEAR(budget.stored_energy + budget.dissipated_energy, 0.0, 1e-6);
}

/// The side faces are free, and the window drops the layer of a particle that has left through one.
TEST(MovingTerrain, ParticleOutsideTheSidesStopsTheRun) {
  TerrainParameters parameters = snow_bed();
  set_boundary(parameters, {"smooth", "smooth", "free", "free", "rough", "free"});
  parameters.window = true;
  ContinuumTerrain ground(parameters, Communicator());
  for (int step = 0; step < parameters.remap_interval - 1; ++step) ground.advance(1e-7);
  ground.advance(1e-7);
  ground.follow(0.3);
  Particles& particles = ground.groups()[0].particles;
  Eigen::Map<Vector3>(particles.data(column::velocity)).y() = -1e4;  // in the first layer
  particles.data(column::y)[0] = ground.grid().axis(1).lower() + 1e-6;
  EXPECT_THAT(test::error_of<StateError>([&] {
                for (int step = 0; step < 2 * parameters.remap_interval; ++step)
                  ground.advance(1e-7);
              }),
              HasSubstr("outside of the grid"));
}

TEST(MovingTerrain, GradedAxisAlongTheTravelIsRefused) {
  TerrainParameters parameters = snow_bed();
  parameters.window = true;
  set_boundary(parameters, {"smooth", "smooth", "smooth", "smooth", "rough", "free"});
  parameters.x = {-0.2, 0.2, cell, -0.1, 0.1, 1.2};
  EXPECT_THAT(test::error_of<InputError>(
                  [&] { ContinuumTerrain ground(parameters, Communicator(), "fix soil"); }),
              HasSubstr("fix soil moves along a graded x axis"));
}

TEST(Terrain, StableStepIsTheCourantNumberOfTheShortestCell) {
  TerrainParameters parameters =
      box(material_of(elastic(1e6, 0.25, 1000)), {0, 0, 0}, {0.2, 0.2, 0.2}, 0.05);
  parameters.z = even(0, 0.2, 0.025);
  parameters.cfl = 0.3;
  ContinuumTerrain ground(parameters, Communicator());
  EXPECT_NEAR(ground.stable_time_step(), 0.3 * 0.025 / std::sqrt(1.2e6 / 1000), 1e-9);
  set_motion(ground, {30.0, 0, 0});
  ground.advance(1e-9);
  EXPECT_NEAR(ground.stable_time_step(), 0.3 * 0.025 / (std::sqrt(1.2e6 / 1000) + 30.0), 1e-9);
}

TEST(Terrain, ParticleOutsideTheGridStopsTheRun) {
  TerrainParameters parameters =
      box(material_of(elastic(1e6, 0.25, 1000)), {0, 0, 0}, {0.2, 0.2, 0.2}, 0.05);
  ContinuumTerrain ground(parameters, Communicator());
  set_motion(ground, {10.0, 0, 0});  // all faces are free
  EXPECT_THAT(test::error_of<StateError>([&] {
                for (int n = 0; n < 1000; ++n) ground.advance(1e-4);
              }),
              HasSubstr("outside of the grid (x 0 to 0.2, y 0 to 0.2, z 0 to 0.2 "
                        "m): enlarge the grid ('clearance_above', 'length', 'width')"));
}

/// A particle close to a wall that moves towards it is stopped there, for any remap interval; the
/// place half-way through the interval would be beyond.
TEST(Terrain, ParticleAtAWallStaysInside) {
  TerrainParameters parameters =
      box(material_of(elastic(1e6, 0.25, 1000)), {0, 0, 0}, {0.2, 0.2, 0.2}, 0.05);
  set_boundary(parameters, {"smooth", "free", "smooth", "smooth", "smooth", "free"});
  ContinuumTerrain ground(parameters, Communicator());
  ground.groups()[0].particles.data(column::x)[0] = 1e-6;
  set_motion(ground, {-1.0, 0, 0});
  for (int n = 0; n < 32; ++n) ground.advance(1e-5);
  EXPECT_GE(ground.groups()[0].particles.data(column::x)[0], 0.0);
}

TEST(Terrain, SurfaceInsideACellIsRefused) {
  TerrainParameters parameters =
      box(material_of(elastic(1e6, 0.25, 1000)), {0, 0, 0}, {0.2, 0.2, 0.2}, 0.05);
  parameters.z = even(0, 0.32, 0.05);  // becomes six cells of 5.3 cm
  EXPECT_THAT(test::error_of<InputError>(
                  [&] { ContinuumTerrain ground(parameters, Communicator(), "fix soil"); }),
              HasSubstr("fix soil has its surface at z = 0.2 m, inside of a cell; "
                        "allowed: the height of an end of a cell"));
}

TEST(Terrain, ParticlesOfALayerHaveItsLaw) {
  TerrainParameters parameters = box(material_of(snow()), {0, 0, 0}, {0.1, 0.1, 0.2}, 0.025);
  parameters.layers = {{material_of(snow()), 0.05}, {material_of(elastic(1e7, 0.3, 1800)), 0.0}};
  ContinuumTerrain ground(parameters, Communicator());
  ASSERT_EQ(ground.groups().size(), 2u);
  EXPECT_EQ(ground.groups()[0].particles.size(), 4u * 4u * 2u * 8u);
  EXPECT_EQ(ground.groups()[1].particles.size(), 4u * 4u * 6u * 8u);
  EXPECT_NEAR(sums_of(ground).mass, 0.01 * (0.05 * 200 + 0.15 * 1800), 1e-9);
}

/// Along x and across: 0.06 m of snow, and 0.04 m with a crust on the other material.
TEST(Terrain, ParticlesOfAPatchHaveItsLayers) {
  for (const int axis : {0, 1}) {
    TerrainParameters parameters = box(material_of(snow()), {0, 0, 0}, {0.1, 0.1, 0.2}, 0.01);
    parameters.layers = {{material_of(snow()), 0.2},
                         {material_of(elastic(1e7, 0.3, 900)), 0.05},
                         {material_of(elastic(1e7, 0.3, 1800)), 0.0}};
    parameters.patch_axis = axis;
    parameters.patches = {{0.06, 1}};
    ContinuumTerrain ground(parameters, Communicator());
    ASSERT_EQ(ground.groups().size(), 3u);
    EXPECT_EQ(ground.groups()[0].particles.size(), 6u * 10u * 20u * 8u);
    EXPECT_EQ(ground.groups()[1].particles.size(), 4u * 10u * 5u * 8u);
    EXPECT_NEAR(sums_of(ground).mass, 0.006 * 0.2 * 200 + 0.004 * (0.05 * 900 + 0.15 * 1800), 1e-9);
    EXPECT_LT(ground.groups()[0].particles.position(0)[axis], 0.06);
    for (std::size_t p = 0; p < ground.groups()[2].particles.size(); ++p)
      ASSERT_GT(ground.groups()[2].particles.position(p)[axis], 0.06);
  }
}

/// Which particle a law refuses, not which block it was in.
TEST(Terrain, ErrorOfALawNamesTheParticle) {
  TerrainParameters parameters = box(material_of(snow()), {-0.1, -0.1, 0}, {0.1, 0.1, depth}, cell);
  ContinuumTerrain ground(parameters, Communicator());
  Particles& particles = ground.groups()[0].particles;
  const std::size_t broken = particles.size() - 5;
  // State that only the law reads: a fault there touches no other particle.
  particles.data(column::state + *parameters.layers[0].material->find_field("eps_vol_pl"))[broken] =
      std::nan("");
  const Vector3 x = particles.position(broken);
  set_motion(ground, Vector3::Zero(), Vector3(0.0, 0.0, -10.0).asDiagonal());  // all yield
  EXPECT_THAT(
      test::error_of<StateError>([&] { ground.advance(1e-5); }),
      HasSubstr(fmt::format("the particle at {:.4g} {:.4g} {:.4g} m: law", x[0], x[1], x[2])));
}

}  // namespace
}  // namespace furrow::continuum_terrain_test
