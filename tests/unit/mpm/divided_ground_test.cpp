// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/discontinuities/divided_ground.h"

#include <gmock/gmock.h>

#include <random>

#include "furrow/core/error.h"
#include "terrain_scene.h"
#include "tests/support/bar.h"
#include "tests/support/checkpoints.h"
#include "tests/support/error_of.h"

namespace furrow::divided_ground_test {
namespace {

using namespace testing_terrain;

constexpr double cell = 0.05;

TerrainParameters block() {
  TerrainParameters p =
      box(material_of(elastic(1e5, 0.2, 1000)), {-0.3, -0.15, -0.3}, {0.3, 0.15, 0.3}, cell);
  p.thin_parts = true;
  return p;
}

/// A wall across x whose lower end is at a height; without a contact: it divides the ground, and
/// presses on nothing.
struct Divided {
  explicit Divided(const TerrainParameters& parameters, double lower = -0.4)
      : ground(parameters, Communicator()), wall(test::bar({0.01, 1.0, 1.0})) {
    wall.x.row(2).array() += lower;
    parts = find_thin_parts(wall, 2.5 * cell, 8 * cell, DividedGround::fields);
  }
  void run(int steps) {
    for (int n = 0; n < steps; ++n) {
      ground.divide_by(wall, parts);
      ground.advance(5e-4);
    }
  }
  /// Largest speed of the particles on one side [m/s].
  double speed(double side) {
    double most = 0.0;
    for_particles(ground, [&](Particles& particles, std::size_t p) {
      if (side * particles.data(column::initial_x)[p] > 0.0)
        most = std::max(most, particles.velocity(p).norm());
    });
    return most;
  }
  ContinuumTerrain ground;
  Surface wall;
  std::vector<ThinPart> parts;
};

/// The ground before the wall moves away, as one body; what is behind it feels nothing.
TEST(DividedGround, GroundOnBothSidesOfAWallMovesSeparately) {
  const auto pull = [](Divided& scene) {
    scene.run(16);  // until particles have their fields
    for_particles(scene.ground, [&](Particles& particles, std::size_t p) {
      particles.data(column::velocity)[4 * p] = particles.position(p).x() > 0.0 ? 0.5 : 0.0;
    });
    scene.run(40);
  };
  Divided through(block());
  pull(through);
  EXPECT_EQ(through.speed(-1.0), 0.0);
  EXPECT_NEAR(through.speed(1.0), 0.5, 1e-12);
  TerrainParameters joined = block();
  joined.thin_parts = false;
  Divided whole(joined);
  pull(whole);
  EXPECT_GT(whole.speed(-1.0), 0.05);
  Divided half(block(), 0.1);  // below the wall the ground is of one piece
  pull(half);
  EXPECT_GT(half.speed(-1.0), 0.05);
}

void stir(ContinuumTerrain& ground) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-0.3, 0.3);
  for_particles(ground, [&](Particles& particles, std::size_t p) {
    for (int a = 0; a < 3; ++a)
      particles.data(column::velocity)[4 * p + static_cast<std::size_t>(a)] =
          any(random) + (a == 0 ? 0.2 : 0.0);
  });
}

TEST(DividedGround, KeepsMomentumAndBalancesEnergy) {
  for (const int interval : {1, 16}) {
    TerrainParameters p = block();
    p.remap_interval = interval;
    p.x = even(-0.3, 0.5, cell);
    Divided scene(p, -0.05);
    carve(scene.ground, [](const Vector3& x) {
      return x.x() < 0.25 && x.x() > -0.25 && std::abs(x.y()) < 0.1 && std::abs(x.z()) < 0.25;
    });
    scene.run(16);
    stir(scene.ground);
    const Sums before = sums_of(scene.ground);
    scene.run(100);
    const Sums after = sums_of(scene.ground);
    EXPECT_LT((after.momentum - before.momentum).norm(), 1e-12 * before.momentum.norm());
    EXPECT_LT((after.angular - before.angular).norm(),
              (interval == 1 ? 1e-12 : 1e-3) * before.momentum.norm());
    const EnergyBudget budget = scene.ground.energy_budget();
    EXPECT_LT(std::abs(budget.residual()), 1e-3 * before.kinetic);
  }
}

TEST(DividedGround, ContinuesBitForBit) {
  for (const int steps : {32, 37, 41}) {
    Divided first(block(), -0.05), second(block(), -0.05);
    first.run(16);
    stir(first.ground);
    first.run(steps);
    test::hand_over(first.ground, second.ground);
    first.run(50);
    second.run(50);
    EXPECT_TRUE(test::state_of(first.ground) == test::state_of(second.ground)) << steps;
  }
}

/// A block that is as thick as long has no thin part.
TEST(DividedGround, GroundWithoutThinPartsIsUndivided) {
  const auto speed = [](bool thin_parts) {
    TerrainParameters p = block();
    p.thin_parts = thin_parts;
    Divided scene(p);
    scene.wall = test::bar({0.2, 0.2, 0.2});
    scene.parts = find_thin_parts(scene.wall, 2.5 * cell, 8 * cell, DividedGround::fields);
    stir(scene.ground);
    scene.run(40);
    return sums_of(scene.ground).kinetic;
  };
  EXPECT_EQ(speed(true), speed(false));
}

TEST(DividedGround, RefusesGroundWithOtherFields) {
  const auto refusal = [](auto change) {
    TerrainParameters p = block();
    change(p);
    return test::error_of<InputError>([&] { ContinuumTerrain(p, Communicator()); });
  };
  EXPECT_THAT(refusal([](TerrainParameters& p) {
                p.slide = SlideSurface{SlidePlane{Vector3::Zero(), Vector3::UnitX()}, 0.0};
              }),
              ::testing::HasSubstr("'thin_parts' is given with a slide surface"));
  EXPECT_THAT(refusal([](TerrainParameters& p) { p.sleep_tolerance = 0.01; }),
              ::testing::HasSubstr("'thin_parts' is given with 'sleep_tolerance'"));
  EXPECT_THAT(refusal([](TerrainParameters& p) { p.surface_mesh = true; }),
              ::testing::HasSubstr("'thin_parts' is given with 'surface_mesh yes'"));
}

}  // namespace
}  // namespace furrow::divided_ground_test
