// SPDX-License-Identifier: GPL-2.0-or-later
// Noise of particles that cross from cell to cell under stress.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../../unit/mpm/terrain_scene.h"
#include "tests/support/max_error.h"

namespace furrow::crossing_test {
namespace {

using namespace testing_terrain;

struct Noise {
  double rms, worst;  // of the axial stress in the middle of the bar, over the stress
};

/// A bar under constant axial pressure, held sideways, flies along itself through cells: its stress
/// should stay uniform.
Noise noise_of(double strain, double speed) {
  const double cell = 0.05, E = 1e6, nu = 0.3, M = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)),
               pressure = M * strain, half = 0.5;
  TerrainParameters p = box(material_of(elastic(E, nu, 1000)), {-1, 0, 0}, {2, cell, cell}, cell);
  set_boundary(p, {"free", "free", "smooth", "smooth", "smooth", "smooth"});
  ContinuumTerrain ground(p, Communicator());
  carve(ground, [half](const Vector3& x) { return std::abs(x.x()) < half; });
  for_particles(ground, [&](Particles& particles, std::size_t n) {
    VectorX state = particles.state(n);
    state[0] = -pressure;
    state[1] = state[2] = nu / (1 - nu) * state[0];
    particles.set_state(n, state);
  });
  set_motion(ground, {speed, 0, 0});
  test::MaxError worst;
  double time = 0.0, square = 0.0;
  while (time < 0.4) {
    const double dt = ground.stable_time_step();
    Particles& particles = ground.groups()[0].particles;
    for (std::size_t n = 0; n < particles.size(); ++n) {
      const double initial = particles.data(column::initial_x)[n], side = initial > 0 ? 1.0 : -1.0;
      if (std::abs(initial) > half - 0.5 * cell)
        ground.add_point_force({0, n}, {-side * pressure * cell * cell / 4, 0, 0},
                               particles.position(n) + Vector3(side * 0.25 * cell, 0, 0));
    }
    ground.advance(dt);
    time += dt;
    for (std::size_t n = 0; n < particles.size(); ++n) {
      if (std::abs(particles.data(column::initial_x)[n]) > 0.5 * half) continue;
      const double error = particles.data(column::state)[n] / -pressure - 1.0;
      square += error * error;
      worst.add(error);
    }
  }
  return {std::sqrt(square / static_cast<double>(worst.count())), worst.max()};
}

/// At rest a uniform stress stays to rounding of the ends; through eight cells at 1 m/s the noise
/// is that of the quadratic spline.
TEST(CellCrossing, CellCrossingNoiseIsSmall) {
  const Noise rest = noise_of(0.001, 0.0), small = noise_of(0.001, 1.0),
              large = noise_of(0.05, 1.0);
  RecordProperty("noise", fmt::format("at rest rms {:.1e}; moving, strain 0.1 %: rms {:.2e} worst "
                                      "{:.2e}; strain 5 %: rms {:.2e} worst {:.2e}",
                                      rest.rms, small.rms, small.worst, large.rms, large.worst));
  EXPECT_LT(rest.rms, 0.01);
  EXPECT_LT(small.rms, 0.03);
  EXPECT_LT(large.rms, 0.03);
}

}  // namespace
}  // namespace furrow::crossing_test
