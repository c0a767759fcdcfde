// SPDX-License-Identifier: GPL-2.0-or-later
// Continuum ground whose surface is not flat: its volume, its stress, and the ground that a moving
// window adds.

#include <cmath>
#include <map>

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "terrain_scene.h"
#include "tests/support/checkpoints.h"
#include "tests/support/error_of.h"

namespace furrow::relief_test {
namespace {

using namespace testing_terrain;
using test::error_of;
using ::testing::HasSubstr;

constexpr double depth = 0.3, cell = 0.05, wavelength = 0.4, amplitude = 0.04, rho = 1500.0;

TerrainParameters washboard(double height = amplitude, double length = 0.8) {
  TerrainParameters ground =
      box(material_of(elastic(1e7, 0.25, rho)), {0.0, 0.0, 0.0}, {length, 0.2, depth}, cell);
  ground.z = even(0.0, depth + 0.2, cell);
  set_boundary(ground, {"smooth", "smooth", "smooth", "smooth", "rough", "free"});
  ground.gravity = {0.0, 0.0, -standard_gravity};
  ground.initial_stress = true;
  ReliefParameters relief;
  relief.washboard = Vector2(wavelength, height);
  ground.relief = GroundRelief(relief, "ground");
  return ground;
}

/// Tops of the columns of particles, by place.
std::map<double, double> tops(ContinuumTerrain& ground) {
  std::map<double, double> top;
  for_particles(ground, [&](const Particles& particles, std::size_t p) {
    const double end = particles.position(p).z() + particles.data(column::half_z)[p];
    double& highest = top.emplace(particles.position(p).x(), end).first->second;
    highest = std::max(highest, end);
  });
  return top;
}

double surface_at(double x) { return depth + amplitude * std::sin(2.0 * pi * x / wavelength); }

/// Whole waves have the volume of flat ground; every column is filled from the base to the surface.
TEST(Relief, ParticlesFillTheGroundFromTheBaseToTheSurface) {
  ContinuumTerrain ground(washboard(), Communicator());
  double volume = 0.0, lowest = 1.0;
  for_particles(ground, [&](const Particles& particles, std::size_t p) {
    volume += particles.data(column::volume)[p] * particles.volume_ratio(p);
    lowest = std::min(lowest, particles.position(p).z() - particles.data(column::half_z)[p]);
  });
  EXPECT_NEAR(volume / (0.8 * 0.2 * depth), 1.0, 1e-12);
  EXPECT_NEAR(lowest, 0.0, 1e-12);
  for (const auto& [x, top] : tops(ground)) EXPECT_NEAR(top, surface_at(x), 1e-12) << x;
}

TEST(Relief, EveryParticleCarriesTheWeightAboveIt) {
  ContinuumTerrain ground(washboard(), Communicator());
  const double half = 0.25 * cell;
  for_particles(ground, [&](const Particles& particles, std::size_t p) {
    const Vector3 x = particles.position(p);
    if (x.z() < 2.0 * half) return;  // the lowest are cut by the base
    const double weight = rho * standard_gravity * (surface_at(x.x()) - x.z());
    EXPECT_NEAR(-particles.state(p)[field::stress + 2] / weight, 1.0, 2e-3);
  });
}

/// Ground that a window adds ahead is that of a longer ground from the start.
TEST(Relief, MovingWindowContinuesTheProfile) {
  TerrainParameters moving = washboard();
  moving.window = true;
  ContinuumTerrain window(moving, Communicator()), whole(washboard(amplitude, 1.6), Communicator());
  window.follow(1.0);
  while (window.travelled() < 0.55) window.advance(window.stable_time_step());
  const std::map<double, double> all = tops(whole);
  int columns = 0;
  for (const auto& [x, top] : tops(window)) {
    if (x < 0.8 + cell) continue;
    const auto same = all.lower_bound(x - 1e-9);
    ASSERT_NE(same, all.end());
    EXPECT_NEAR(same->first, x, 1e-3);
    EXPECT_NEAR(top, same->second, 1e-3) << x;
    ++columns;
  }
  EXPECT_GT(columns, 15);
}

TEST(Relief, ContinuedWindowIsEqualInEveryBit) {
  TerrainParameters moving = washboard();
  moving.window = true;
  ContinuumTerrain whole(moving, Communicator()), restored(moving, Communicator());
  const auto run = [](ContinuumTerrain& ground, double x, int steps) {
    ground.follow(x);
    for (int n = 0; n < steps; ++n) ground.advance(2e-4);
  };
  run(whole, 0.6, 40);
  test::hand_over(whole, restored);
  run(whole, 0.8, 40);
  run(restored, 0.8, 40);
  EXPECT_GT(whole.travelled(), 0.3);
  EXPECT_TRUE(test::state_of(whole) == test::state_of(restored));
}

TEST(Relief, HeightsBeyondDepthAndClearanceAreRefused) {
  const auto refusal = [](double height) {
    return error_of<InputError>([&] { ContinuumTerrain(washboard(height), Communicator()); });
  };
  EXPECT_THAT(refusal(0.18), HasSubstr("raise 'clearance_above'"));
  TerrainParameters deep = washboard(0.25);
  deep.z = even(0.0, depth + 0.4, cell);
  EXPECT_THAT(error_of<InputError>([&] { ContinuumTerrain(deep, Communicator()); }),
              HasSubstr("raise 'depth'"));
}

}  // namespace
}  // namespace furrow::relief_test
