// SPDX-License-Identifier: GPL-2.0-or-later
// Ground with a trough that grains fill: what fills it up to its faces, what lies on them, and that
// it stays at rest under what grains would press with.
#include "furrow/mpm/ground/trough.h"

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "furrow/mpm/ground/terrain_size.h"
#include "terrain_scene.h"
#include "tests/support/checkpoints.h"
#include "tests/support/error_of.h"

namespace furrow::trough_test {
namespace {

using ::testing::HasSubstr;

constexpr double length = 0.5, width = 0.8, depth = 0.3, rho = 1500.0, nu = 0.25,
                 weight = rho * standard_gravity;  // of ground and grains [N/m^3]
constexpr Trough trough = {0.4, 0.15};

/// The grid goes on above the surface; the bottom of the trough is at z = 0.15, its sides at y =
/// -0.2 and 0.2.
TerrainParameters ground_with_trough(Trough shape = trough, double cell = 0.05) {
  return testing_terrain::ground_with_trough(testing_terrain::elastic(1e7, nu, rho),
                                             {length, width, depth}, 0.5, shape, cell);
}

/// With the stress of its weight, and that of grains of its density in the trough.
TerrainParameters heavy_ground(double cell = 0.05) {
  TerrainParameters ground = ground_with_trough(trough, cell);
  ground.gravity = {0.0, 0.0, -standard_gravity};
  ground.initial_stress = true;
  ground.surcharge = weight * trough.depth;
  return ground;
}

template <class Number>
double sum_over(ContinuumTerrain& ground, Number&& number) {
  double sum = 0.0;
  for (const ParticleGroup& group : ground.groups())
    for (std::size_t p = 0; p < group.particles.size(); ++p) sum += number(group, p);
  return sum;
}

double mass_of(ContinuumTerrain& ground) {
  return sum_over(ground, [](const ParticleGroup& group, std::size_t p) { return group.mass(p); });
}

TEST(Trough, GroundHasTheMassOfItsVolumeAndTheCountOfTheEstimate) {
  const double section = width * depth - trough.width * trough.depth;
  TerrainParameters graded = ground_with_trough();
  graded.y = {-0.5 * width, 0.5 * width, 0.05, -0.25, 0.25, 1.3};  // cells grow beside the trough
  for (const TerrainParameters& parameters : {ground_with_trough(), graded}) {
    ContinuumTerrain ground(parameters, Communicator());
    EXPECT_NEAR(mass_of(ground) / (rho * length * section), 1.0, 1e-12);
  }
  const ContinuumTerrain ground(ground_with_trough(), Communicator());
  EXPECT_EQ(ground.particle_count(), size_of(ground_with_trough()).particles);
}

/// -sigma_zz is the weight of all that lies above, of ground or of grains; compressed particles
/// still fill the volume.
TEST(Trough, EveryLevelCarriesTheWeightAbove) {
  ContinuumTerrain ground(heavy_ground(), Communicator());
  double volume = 0.0;
  for (const ParticleGroup& group : ground.groups())
    for (std::size_t p = 0; p < group.particles.size(); ++p) {
      const Vector3 x = group.particles.position(p);
      const bool in_trough = std::abs(x.y()) < 0.5 * trough.width;
      EXPECT_LT(x.z(), in_trough ? depth - trough.depth : depth);
      EXPECT_NEAR(-group.particles.state(p)[field::stress + 2] / (weight * (depth - x.z())), 1.0,
                  1e-3);
      volume += group.particles.data(column::volume)[p] * group.particles.volume_ratio(p);
    }
  EXPECT_NEAR(volume / (length * (width * depth - trough.width * trough.depth)), 1.0, 1e-12);
}

TEST(Trough, SurfaceMeshCoversAllFaces) {
  for (const std::size_t every : {1, 2, 3, 5}) {
    TerrainParameters parameters = ground_with_trough();
    parameters.surface_mesh_every = every;
    ContinuumTerrain ground(parameters, Communicator());
    const Surface& sheet = ground.surface();
    EXPECT_NEAR(sheet.total_area(), length * (width + 2.0 * trough.depth), 1e-12);
    Vector3 area = Vector3::Zero();
    for (std::size_t t = 0; t < sheet.triangle_count(); ++t) area += sheet.area_vector(t);
    EXPECT_NEAR((area - Vector3(0.0, 0.0, length * width)).norm(), 0.0, 1e-12);
    EXPECT_GT(sheet.minimum_angle(), 0.15);
    for (Eigen::Index n = 0; n < sheet.x.cols(); ++n) {
      const double y = std::abs(sheet.x(1, n)), z = sheet.x(2, n), side = 0.5 * trough.width;
      const double off = y < side - 1e-9   ? std::abs(z - (depth - trough.depth))
                         : y > side + 1e-9 ? std::abs(z - depth)
                                           : std::max({0.0, z - depth, 0.15 - z});
      EXPECT_LT(off, 1e-12) << sheet.x.col(n).transpose();
    }
  }
}

/// Presses as grains at rest that fill the trough and have the ground's density and K0 = nu/(1 -
/// nu).
void press_as_grains_at_rest(Surface& sheet) {
  sheet.clear_forces();
  for (std::size_t t = 0; t < sheet.triangle_count(); ++t) {
    const Vector3i& nodes = sheet.triangles[t];
    const Vector3 area = sheet.area_vector(t);
    const double z = (sheet.x(2, nodes[0]) + sheet.x(2, nodes[1]) + sheet.x(2, nodes[2])) / 3.0;
    const double pressure = weight * (depth - z);
    const Vector3 force(0.0, -nu / (1.0 - nu) * pressure * area.y(), -pressure * area.z());
    for (int j = 0; j < 3; ++j) sheet.f.col(nodes[j]) += force / 3.0;
  }
}

struct Rest {
  double moved;  // largest displacement of a node, over what weight that comes on at once settles
  double base;   // mean force of the base over rho g h, the weight of ground and grains
};

Rest after_rest(double cell) {
  ContinuumTerrain ground(heavy_ground(cell), Communicator());
  const Matrix3X before = ground.surface().x;
  const double dt = ground.stable_time_step();
  const int steps = static_cast<int>(0.1 / dt);
  for (int n = 0; n < steps; ++n) {
    press_as_grains_at_rest(ground.surface());
    ground.advance(dt);
  }
  const double wave_modulus = 1e7 * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)),
               settlement = weight * depth * depth / (2.0 * wave_modulus);
  return {
      (ground.surface().x - before).cwiseAbs().maxCoeff() / settlement,
      ground.boundary_impulse(Face::z_lower).z() / (steps * dt * weight * depth * width * length)};
}

/// Closed form: nothing moves, and the base gives rho g h over the whole width. The faces give way
/// by an error of the grid, in the cells next to them, which halves with these.
TEST(Trough, GroundUnderGrainsStaysAtRestAndCarriesThem) {
  const Rest coarse = after_rest(0.05), fine = after_rest(0.025);
  EXPECT_LT(coarse.moved, 0.02);
  EXPECT_LT(fine.moved, 0.6 * coarse.moved);
  EXPECT_NEAR(coarse.base, 1.0, 1e-3);
  EXPECT_NEAR(fine.base, 1.0, 1e-3);
}

TEST(Trough, RestartContinuesBitwise) {
  const auto run = [](ContinuumTerrain& ground, int steps) {
    for (int n = 0; n < steps; ++n) {
      ground.surface().clear_forces();
      ground.surface().f.row(2).setConstant(-0.5);
      ground.advance(1e-4);
    }
  };
  ContinuumTerrain whole(heavy_ground(), Communicator()), first(heavy_ground(), Communicator()),
      continued(heavy_ground(), Communicator());
  run(whole, 42);
  run(first, 21);
  test::restore(continued, test::state_of(first));
  run(continued, 21);
  EXPECT_EQ(test::state_of(continued), test::state_of(whole));
  EXPECT_EQ(continued.surface().x, whole.surface().x);
}

TEST(Trough, ImpossibleTroughIsRefused) {
  struct Case {
    Trough shape;
    const char* said;
  };
  for (const Case& refused : {
           Case{{0.38, 0.15},
                "has a trough 0.38 m wide, which ends inside of a particle's part of "
                "the ground; allowed: an end between two particles; make it 0.35 or "
                "0.4 m wide"},
           Case{{0.4, 0.14}, "has a trough 0.14 m deep"},
           Case{{0.4, 0.14}, "make it 0.125 or 0.15 m deep"},
           Case{{0.1, 0.15}, "has 2 cell(s) across its trough; allowed: at least 3"},
           Case{{0.7, 0.15}, "has 1 cell(s) on either side of its trough; allowed: at least 2"},
           Case{{2.0, 0.15}, "has 0 cell(s) on either side of its trough"},
           Case{{0.4, 0.25}, "has 1 cell(s) below its trough; allowed: at least 2"},
           Case{{0.4, 0.5}, "has 0 cell(s) below its trough"},
       }) {
    EXPECT_THAT(test::error_of<InputError>([&] {
                  ContinuumTerrain ground(ground_with_trough(refused.shape), Communicator(),
                                          "sand");
                }),
                HasSubstr(refused.said));
  }
}

}  // namespace
}  // namespace furrow::trough_test
