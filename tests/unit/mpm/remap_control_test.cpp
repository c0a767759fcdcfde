// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/transfer/remap_control.h"

#include <gtest/gtest.h>

#include "terrain_scene.h"

namespace furrow::remap_control_test {
namespace {

using namespace testing_terrain;

constexpr double cell = 0.1, dt = 1e-3, wave_speed = 40.0, share = 0.95;
constexpr int max_steps = 16;

/// One particle in a grid of cells of 0.1 m.
struct Fixture {
  Fixture()
      : material(material_of(elastic(1e6, 0.25, 1000))),
        discretisation{Grid(Axis(even(0, 1, cell), "x"), Axis(even(0, 1, cell), "y"),
                            Axis(even(0, 1, cell), "z")),
                       groups_of(material), Partition(Communicator(), {1, 1}, discretisation.grid)},
        remap(discretisation, max_steps, share, wave_speed) {
    particles().append(1);
    particles().set_state(0, material->initial_state());
  }
  static std::vector<ParticleGroup> groups_of(const std::shared_ptr<const Material>& material) {
    std::vector<ParticleGroup> groups;
    groups.push_back({material, Particles(*material)});
    return groups;
  }
  Particles& particles() { return discretisation.groups[0].particles; }
  void set_speed(double speed) { particles().data(column::velocity)[2] = speed; }
  void set_volume_ratio(double ratio) {
    particles().data(column::state + field::volume_ratio)[0] = ratio;
  }

  std::shared_ptr<const Material> material;
  Discretisation discretisation;
  RemapControl remap;
};

TEST(RemapControl, GroundAtRestTakesTheLongestInterval) {
  Fixture f;
  EXPECT_FALSE(f.remap.interval_running());
  f.remap.begin_interval(dt);
  EXPECT_EQ(f.remap.steps_left(), max_steps);
  for (int step = 1; step < max_steps; ++step) f.remap.count_step(dt);
  EXPECT_TRUE(f.remap.last_step());
  f.remap.count_step(dt);
  EXPECT_FALSE(f.remap.interval_running());
}

/// A twentieth of a cell, less where the ground is compacted, at least one step.
TEST(RemapControl, FastOrCompactedGroundTakesShorterIntervals) {
  Fixture f;
  f.set_speed(0.05 * cell / (4.5 * dt));
  f.remap.begin_interval(dt);
  EXPECT_EQ(f.remap.steps_left(), 4);
  f.set_volume_ratio(0.5);
  f.remap.begin_interval(dt);
  EXPECT_EQ(f.remap.steps_left(), 2);
  f.set_speed(100.0);
  f.remap.begin_interval(dt);
  EXPECT_EQ(f.remap.steps_left(), 1);
  EXPECT_EQ(f.remap.largest_speed(), 100.0);
}

TEST(RemapControl, FastGroundAtAContactEndsTheInterval) {
  Fixture f;
  f.remap.begin_interval(dt);
  f.remap.raise_largest_speed(0.06 * cell / dt);
  EXPECT_DOUBLE_EQ(f.remap.count_step(dt), 0.06 * cell);
  EXPECT_TRUE(f.remap.interval_running());
  f.remap.count_step(dt);  // 0.12 of a cell
  EXPECT_FALSE(f.remap.interval_running());
}

/// 16 ms are the time in which a wave of 40 m/s crosses 6.4 cells.
TEST(RemapControl, ResidualMotionDecaysIndependentlyOfTheIntervals) {
  Fixture f;
  double kept = 1.0;
  for (const int steps : {1, 3, 12}) {
    f.remap.begin_interval(dt);
    EXPECT_EQ(f.remap.residual_share(), 1.0);
    for (int step = 0; step < steps; ++step) f.remap.count_step(dt);
    kept *= f.remap.residual_share();
  }
  EXPECT_NEAR(kept, share, 1e-14);
  f.set_speed(0.05 * cell / (4.0 * dt));
  f.remap.begin_interval(dt);
  for (int step = 0; step < 4; ++step) f.remap.count_step(dt);
  EXPECT_NEAR(f.remap.residual_share(), share, 1e-14);
}

TEST(RemapControl, StalenessIsTheTravelSinceParticlesWereUpdated) {
  Fixture f;
  f.set_speed(0.05 * cell / (4.5 * dt));
  f.remap.begin_interval(dt);
  EXPECT_EQ(f.remap.staleness(), 0.0);
  f.remap.grid_moved();
  const double travel = f.remap.count_step(dt);
  EXPECT_GT(travel, 0.0);
  EXPECT_EQ(f.remap.staleness(), travel);
  f.remap.particles_updated();
  EXPECT_EQ(f.remap.staleness(), 0.0);
}

}  // namespace
}  // namespace furrow::remap_control_test
