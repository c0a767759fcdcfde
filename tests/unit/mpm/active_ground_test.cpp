// SPDX-License-Identifier: GPL-2.0-or-later
// Ground at rest that is left out of the steps: statics, waves, energies and restarts.
#include "furrow/mpm/active_ground.h"

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "terrain_scene.h"
#include "tests/support/checkpoints.h"
#include "tests/support/error_of.h"

namespace furrow::active_ground_test {
namespace {

using ::testing::HasSubstr;
using namespace testing_terrain;

constexpr double cell = 0.025, depth = 0.1, length = 2.0;  // [m]
constexpr double interval = 2e-4;                          // [s]

/// A strip of snow with its weight: ten tiles along x.
TerrainParameters strip(double tolerance) {
  TerrainParameters parameters = box(material_of(snow()), {0, 0, 0}, {length, 0.1, depth}, cell);
  parameters.z = even(0, depth + 2 * cell, cell);
  parameters.gravity = {0, 0, -standard_gravity};
  parameters.initial_stress = true;
  set_boundary(parameters, {"smooth", "absorbing", "smooth", "smooth", "rough", "free"});
  parameters.sleep_tolerance = tolerance;
  return parameters;
}

/// A plate near the lower end of the strip.
struct Scene : PressedGround {
  explicit Scene(double tolerance, double at = 0.2)
      : PressedGround(strip(tolerance), {PlateShape::square, 0.1, 0.05, 4},
                      {at, 0.05, depth + 1e-4}) {}
  void run(double time, double speed) {
    for (double t = 0.0; t < time - 0.5 * interval; t += interval) {
      plate.prescribe(speed);
      system.advance(interval);
      force = contact->force().z();
    }
  }
  double force = 0.0;  // [N]
};

const Particles& particles_of(const Scene& scene) {
  return const_cast<ContinuumTerrain&>(scene.ground).groups()[0].particles;
}

/// Values in the order of creation, for any order in memory.
std::vector<Vector3> by_id(const Scene& scene, std::size_t column) {
  const Particles& particles = particles_of(scene);
  std::vector<Vector3> values(particles.size());
  for (std::size_t p = 0; p < particles.size(); ++p)
    for (std::size_t a = 0; a < 3; ++a)
      values[static_cast<std::size_t>(particles.data(column::id)[p])][static_cast<int>(a)] =
          particles.data(column + a)[p];
  return values;
}

/// With a tolerance that nothing meets, the ground goes through the loops of active ground.
TEST(ActiveGround, AwakeGroundIsBitwiseTheFullGround) {
  Scene all(0.0), active(1e-12);
  for (Scene* scene : {&all, &active}) {
    scene->touch();
    scene->run(0.02, -0.2);
  }
  EXPECT_EQ(active.ground.active()->awake_share(), 1.0);
  EXPECT_GT(all.force, 50.0);
  EXPECT_EQ(all.force, active.force);
  EXPECT_EQ(by_id(all, column::x), by_id(active, column::x));
  EXPECT_EQ(by_id(all, column::state + field::stress),
            by_id(active, column::state + field::stress));
}

/// The plate sinks at constant speed: its force and the energies, against all of the ground.
TEST(ActiveGround, ErrorOfSleepingIsBelowTheReportedBound) {
  constexpr double tolerance = 0.05;
  Scene all(0.0), active(tolerance);
  double difference = 0.0, mean = 0.0;
  for (Scene* scene : {&all, &active}) scene->touch();
  for (int n = 0; n < 300; ++n) {
    for (Scene* scene : {&all, &active}) scene->run(interval, -0.1);
    if (n < 100) continue;
    difference += (active.force - all.force) / 200.0;
    mean += all.force / 200.0;
  }
  const ActiveGround& ground = *active.ground.active();
  const ActiveGround::Neglect& neglect = ground.neglect();
  EXPECT_LT(ground.awake_share(), 0.8);
  EXPECT_NE(difference, 0.0);
  EXPECT_LT(std::abs(difference), neglect.largest_force);
  EXPECT_LE(neglect.force, tolerance * mean);
  EXPECT_GT(neglect.energy, 0.0);
  EXPECT_LE(neglect.energy, tolerance * active.ground.work().contact);
  const EnergyBudget budget = active.ground.energy_budget();
  const double residual = all.ground.energy_budget().residual();
  EXPECT_LT(std::abs(residual), 1e-3 * budget.contact_work);
  EXPECT_NEAR(budget.residual(), residual, 0.01 * std::abs(residual));
}

/// Sleeping ground keeps place and stress, and its base keeps its weight.
TEST(ActiveGround, SleepingGroundKeepsPlaceStressAndWeight) {
  Scene scene(0.01);
  scene.touch();
  scene.run(0.06, -0.1);
  ASSERT_TRUE(scene.ground.active()->asleep(1.9, 0.05));
  const auto x = by_id(scene, column::x), stress = by_id(scene, column::state + field::stress);
  const double before = scene.ground.boundary_impulse(Face::z_lower).z(),
               momentum = scene.ground.energy_budget().momentum.z();
  double push = 0.0;
  constexpr double time = 0.02;
  for (int n = 0; n < 100; ++n) {
    scene.run(interval, -0.1);
    push += interval * scene.force;
  }
  ASSERT_TRUE(scene.ground.active()->asleep(1.9, 0.05));
  const auto x_after = by_id(scene, column::x),
             stress_after = by_id(scene, column::state + field::stress);
  for (std::size_t p = 0; p < x.size(); ++p)
    if (x[p].x() > 1.8) {
      EXPECT_EQ(x[p], x_after[p]);
      EXPECT_EQ(stress[p], stress_after[p]);
    }
  const double weight = 200.0 * standard_gravity * length * 0.1 * depth;
  const double impulse = scene.ground.boundary_impulse(Face::z_lower).z() - before,
               change = scene.ground.energy_budget().momentum.z() - momentum;
  // the force that holds the border carries the rest
  EXPECT_NEAR(impulse, weight * time + push + change, 0.02 * (weight * time + push));
}

/// Held nodes would balance the weight of level ground.
TEST(ActiveGround, GroundWakesWhenGravityTilts) {
  Scene scene(0.05);
  scene.touch();
  scene.run(0.06, -0.1);
  ASSERT_TRUE(scene.ground.active()->asleep(1.9, 0.05));
  const Vector3 tilted = standard_gravity * Vector3(-std::sin(0.1), 0.0, -std::cos(0.1));
  scene.ground.set_gravity(tilted);
  scene.run(0.004, -0.1);
  EXPECT_EQ(scene.ground.active()->awake_share(), 1.0);
  scene.ground.set_gravity(tilted);  // as a rig does in every step
  scene.run(0.1, -0.1);
  EXPECT_LT(scene.ground.active()->awake_share(), 1.0);
}

/// A weightless elastic bar along x that a force pushes at its absorbing end; the other end is
/// fixed. A plate above, which touches nothing, keeps the first three of five tiles awake.
struct Bar {
  Bar()
      : ground(parameters(), Communicator()),
        above({PlateShape::square, 0.4, 0.05, 4}, {0.2, 0.025, 0.2}) {
    dt = 0.9 * ground.stable_time_step();
  }
  static TerrainParameters parameters() {
    TerrainParameters bar =
        box(material_of(elastic(1e6, 0.0, 1000.0)), {0, 0, 0}, {1.0, 0.05, 0.05}, cell);
    set_boundary(bar, {"absorbing", "smooth", "smooth", "smooth", "smooth", "smooth"});
    bar.sleep_tolerance = 0.1;
    return bar;
  }
  /// @param force  on the particles of the first cells [N]
  void run(int steps, const std::function<double(int)>& force) {
    for (int n = 0; n < steps; ++n) {
      ground.keep_awake_near(above.surface());
      std::vector<std::size_t> loaded;
      const Particles& particles = ground.unsynchronised_groups()[0].particles;
      for (std::size_t p = 0; p < particles.size(); ++p)
        if (particles.position(p).x() < cell) loaded.push_back(p);
      for (const std::size_t p : loaded)
        ground.add_point_force({0, p}, {force(n) / static_cast<double>(loaded.size()), 0, 0},
                               particles.position(p));
      ground.advance(dt);
    }
  }
  double momentum() const { return ground.energy_budget().momentum.x(); }
  bool sleeps() const { return ground.active()->asleep(0.7, 0.02); }
  ContinuumTerrain ground;
  RigidPlate above;
  double dt;
};

/// A wave with the momentum p that is reflected as at a fixed end takes 2 p of it.
TEST(ActiveGround, ReportsTheReflectionOfAWave) {
  constexpr int period = 160;
  constexpr double push = 10.0;  // [N]
  Bar bar;
  bar.run(20 * period, [](int) { return push; });
  ASSERT_TRUE(bar.sleeps());
  const double before = bar.ground.active()->neglect().force;
  constexpr int duration = 30;
  const auto pulse = [](int n) {
    return push * (1.0 + (n < duration ? 0.05 * std::sin(pi * (n + 0.5) / duration) : 0.0));
  };
  const double at_rest = bar.momentum();
  bar.run(duration + 10, pulse);
  const double p = bar.momentum() - at_rest;
  bar.run(2 * period - duration - 10, [](int) { return push; });
  EXPECT_LT(before, 1e-3 * push);
  EXPECT_GT(p, 0.0);
  const double reported = bar.ground.active()->neglect().largest_force - before;
  EXPECT_NEAR(reported * period * bar.dt, 2.0 * p, 0.05 * 2.0 * p);
  EXPECT_TRUE(bar.sleeps());
  // the same wave forty times as strong exceeds the tolerance
  bar.run(period, [&](int n) { return push + 40.0 * (pulse(n) - push); });
  EXPECT_FALSE(bar.sleeps());
}

TEST(ActiveGround, ApproachingBodyWakesTheGround) {
  Scene scene(0.01);
  scene.touch();
  scene.run(0.06, -0.1);
  ASSERT_TRUE(scene.ground.active()->asleep(1.9, 0.05));
  RigidPlate other({PlateShape::square, 0.1, 0.05, 4}, {1.9, 0.05, depth + 5e-3});
  TerrainContact touch(other, scene.ground, ContactParameters{}, false, "other");
  scene.system.add(other, "other");
  scene.system.add(touch, "other");
  scene.run(0.004, -0.1);
  EXPECT_FALSE(scene.ground.active()->asleep(1.9, 0.05));
}

TEST(ActiveGround, ContinuesBitForBit) {
  Scene through(0.01), again(0.01);
  through.touch();
  through.run(0.05, -0.1);
  ASSERT_LT(through.ground.active()->awake_share(), 0.9);
  restart(through, again);
  for (Scene* scene : {&through, &again}) scene->run(0.02, -0.1);
  EXPECT_EQ(through.force, again.force);
  EXPECT_TRUE(test::state_of(through.ground) == test::state_of(again.ground));
}

/// The message of a strip that is changed.
template <class Change>
std::string refusal(Change change) {
  TerrainParameters parameters = strip(0.01);
  change(parameters);
  return test::error_of<InputError>([&] { ContinuumTerrain(parameters, Communicator()); });
}

TEST(ActiveGround, WindowSurfaceMeshAndCreepAreRefused) {
  EXPECT_THAT(refusal([](TerrainParameters& ground) { ground.window = true; }),
              HasSubstr("'sleep_tolerance' is given with 'follow'"));
  EXPECT_THAT(refusal([](TerrainParameters& ground) { ground.surface_mesh = true; }),
              HasSubstr("with 'surface_mesh yes'"));
  EXPECT_THAT(refusal([](TerrainParameters& ground) {
                ground.layers[0].material = material_of(
                    "cohesive_cap density 200 nu_p 0.1 d 2e3 d_density 200 d_exponent 3 beta 30 "
                    "tension_ratio 0.2 relaxation_time 1e-3 elasticity linear E 13.79e6 nu 0.3 "
                    "hardening table p 500 2e4 eps_vol_pl 0 0.593 interpolation log "
                    "beyond extrapolate");
              }),
              HasSubstr("a material that depends on the rate"));
}

}  // namespace
}  // namespace furrow::active_ground_test
