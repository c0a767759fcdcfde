// SPDX-License-Identifier: GPL-2.0-or-later
// Waves in elastic ground: speed and order against closed forms, absorbing faces, graded grids.

#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../../unit/mpm/terrain_scene.h"
#include "tests/support/max_error.h"

namespace furrow::waves_test {
namespace {

using namespace testing_terrain;

constexpr double E = 1e7, nu = 0.25, rho = 1600.0;
const double wave_modulus = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)),
             shear_modulus = E / (2 * (1 + nu));
const double c_p = std::sqrt(wave_modulus / rho), c_s = std::sqrt(shear_modulus / rho);

/// A bar along x between smooth walls, one cell thick: plane waves.
TerrainParameters bar(double length, double cell) {
  TerrainParameters ground =
      box(material_of(elastic(E, nu, rho)), {0, 0, 0}, {length, cell, cell}, cell);
  set_boundary(ground, {"smooth", "smooth", "smooth", "smooth", "smooth", "smooth"});
  return ground;
}

/// Standing wave between smooth walls: velocity s sin(kx) cos(kct), k = pi/length, from a start
/// without strain.
/// @return L2 error of the velocity after a whole period, relative
double standing_wave_error(double cell) {
  const double k = pi, speed = 1e-4;  // strains of 1e-6: linear
  ContinuumTerrain ground(bar(1.0, cell), Communicator());
  for_particles(ground, [&](Particles& particles, std::size_t p) {
    const double x = particles.position(p).x();
    particles.data(column::velocity)[4 * p] = speed * std::sin(k * x);
    particles.data(column::affine)[12 * p] = speed * k * std::cos(k * x);
  });
  const double period = 2 * pi / (k * c_p);
  const int steps = static_cast<int>(std::ceil(period / ground.stable_time_step()));
  for (int n = 0; n < steps; ++n) ground.advance(period / steps);
  double square = 0.0, count = 0.0;
  for_particles(ground, [&](Particles& particles, std::size_t p) {
    const double error =
        particles.velocity(p).x() / speed - std::sin(k * particles.position(p).x());
    square += error * error;
    count += 0.5;  // mean square of the sine
  });
  return std::sqrt(square / count);
}

/// The transfers take 0.024 (kh)^4 of the amplitude in a step: third order at a given Courant
/// number. Splines and leapfrog are of second.
TEST(StandingWave, AmplitudeConvergesToTheClosedForm) {
  const double coarse = standing_wave_error(1.0 / 8), medium = standing_wave_error(1.0 / 16),
               fine = standing_wave_error(1.0 / 32);
  RecordProperty("errors", fmt::format("{:.2e} {:.2e} {:.2e}", coarse, medium, fine));
  RecordProperty(
      "orders", fmt::format("{:.2f} {:.2f}", std::log2(coarse / medium), std::log2(medium / fine)));
  EXPECT_GT(std::log2(coarse / medium), 2.0);
  EXPECT_GT(std::log2(medium / fine), 2.0);
  EXPECT_LT(fine, 5e-4);
}

/// A wave to the right, v = s exp(-((x - at)/width)^2), sigma = -rho c v; or to the left.
void start_pulse(ContinuumTerrain& ground, double at, double width, double speed,
                 int direction = 1) {
  for_particles(ground, [&](Particles& particles, std::size_t p) {
    const double s = (particles.position(p).x() - at) / width, v = speed * std::exp(-s * s);
    particles.data(column::velocity)[4 * p] = v;
    particles.data(column::affine)[12 * p] = -2 * s / width * v;
    VectorX state = particles.state(p);
    state[0] = -direction * wave_modulus * v / c_p;
    state[1] = state[2] = nu / (1 - nu) * state[0];
    particles.set_state(p, state);
  });
}

void run(ContinuumTerrain& ground, double duration) {
  double time = 0.0;
  while (time < duration) {
    const double dt = std::min(ground.stable_time_step(), duration - time + 1e-12);
    ground.advance(dt);
    time += dt;
  }
}

double measured_speed(double cell) {
  ContinuumTerrain ground(bar(4.0, cell), Communicator());
  start_pulse(ground, 1.0, 0.25, 1e-4);
  const auto centre = [&] {
    double sum = 0.0, first = 0.0;
    for_particles(ground, [&](Particles& particles, std::size_t p) {
      sum += particles.velocity(p).x();
      first += particles.velocity(p).x() * particles.position(p).x();
    });
    return first / sum;
  };
  const double from = centre();
  run(ground, 1.8 / c_p);
  return (centre() - from) / (1.8 / c_p);
}

/// c = sqrt(M/rho), M = E(1 - nu)/((1 + nu)(1 - 2 nu)).
TEST(PressureWave, SpeedIsThatOfTheWaveModulus) {
  const double coarse = measured_speed(1.0 / 8), fine = measured_speed(1.0 / 16);
  RecordProperty("speed_over_c", fmt::format("{:.5f} {:.5f}", coarse / c_p, fine / c_p));
  EXPECT_NEAR(coarse / c_p, 1.0, 5e-3);
  EXPECT_NEAR(fine / c_p, 1.0, 5e-4);
}

double largest_speed_left(ContinuumTerrain& ground) {
  test::MaxError speed;
  for_particles(ground,
                [&](Particles& particles, std::size_t p) { speed.add(particles.velocity(p).x()); });
  return speed.max();
}

constexpr double bar_length = 2.0, pulse_width = 0.2, pulse_speed = 1e-4;

double reflection(const char* end, double cell) {
  TerrainParameters parameters = bar(bar_length, cell);
  parameters.boundary[Face::x_upper] = boundary_kind(end);
  ContinuumTerrain ground(parameters, Communicator());
  start_pulse(ground, 1.0, pulse_width, pulse_speed);
  run(ground, 1.8 / c_p);
  return largest_speed_left(ground) / pulse_speed;
}

/// With sigma = -rho c v - (rho c^2/L) u at the face, an arriving displacement f comes back as g
/// with g' = -(c/2L)(f + g): the dashpot alone would be quiet, the spring that holds statically
/// reflects what is longer than L. For a harmonic wave |R| = 1/sqrt(1 + 4 k^2 L^2): 8 % for a wave
/// as long as L, the length of a bar whose other end is a plane of symmetry.
TEST(AbsorbingFace, ReflectionIsThatOfTheSpring) {
  const double length = bar_length;
  double f = 0.0, g = 0.0, expected = 0.0;
  const double ds = 1e-5;  // of c t
  for (double s = -1.0; s < 0.8; s += ds) {
    f += ds * std::exp(-s * s / (pulse_width * pulse_width));
    const double slope = -(f + g) / (2 * length);
    g += ds * slope;
    expected = std::max(expected, std::abs(slope));
  }
  const double coarse = reflection("absorbing", 1.0 / 32),
               fine = reflection("absorbing", 1.0 / 128);
  RecordProperty("reflection",
                 fmt::format("{:.4f} {:.4f}, closed form {:.4f}", coarse, fine, expected));
  EXPECT_NEAR(coarse, expected, 0.001);
  EXPECT_NEAR(fine, expected, 0.001);
  EXPECT_GT(reflection("smooth", 1.0 / 16), 0.85);  // against a wall and a free end
  EXPECT_GT(reflection("free", 1.0 / 16), 0.85);
}

/// As above, while the ground moves on at a tenth of the wave speed. Ahead, the far field gives way
/// by u with u' = v - (V/L) u, and g' = -u/2L; behind, what comes back is that of an end at rest
/// which the pulse reaches sooner. Cells that enter ahead are at rest and without stress: they
/// ring, and take a part of what comes back.
TEST(AbsorbingFace, MovingFaceReflectsAsTheSpring) {
  const double length = 0.5 * bar_length, along = 0.1;  // V/c
  const auto measured = [&](int direction, double cell) {
    TerrainParameters parameters = bar(bar_length, cell);
    parameters.window = true;
    parameters.boundary[Face::x_lower] = parameters.boundary[Face::x_upper] =
        BoundaryKind::absorbing;
    ContinuumTerrain ground(parameters, Communicator());
    start_pulse(ground, 1.0, pulse_width, pulse_speed, direction);
    double time = 0.0;
    while (time < 1.8 / c_p) {
      const double dt = ground.stable_time_step();
      ground.follow(1.0 + along * c_p * time);
      ground.advance(dt);
      time += dt;
    }
    EXPECT_GT(ground.travelled(), 0.12);
    EXPECT_LT(largest_speed_left(ground) / pulse_speed, 0.35);  // of what rings
    // Each cell that enters ahead lacks the stress of its neighbour and rings: means over 0.1 m.
    std::map<int, std::pair<double, double>> sums;
    for_particles(ground, [&](Particles& particles, std::size_t p) {
      auto& [sum, count] = sums[static_cast<int>(particles.position(p).x() / 0.1)];
      sum += particles.velocity(p).x();
      count += 1.0;
    });
    test::MaxError mean;
    for (const auto& [bin, sum] : sums) mean.add(sum.first / sum.second);
    return mean.max() / pulse_speed;
  };
  const auto expected = [&](int direction) {
    double u = 0.0, largest = 0.0;
    const double ds = 1e-5;  // of c t
    for (double s = 0.0; s < 1.8; s += ds) {
      const double behind_pulse = 1.0 + direction * along * s - s;
      u += ds * (std::exp(-std::pow(behind_pulse / pulse_width, 2)) - u / (2 * length) -
                 (direction > 0 ? along * u / length : 0.0));
      largest = std::max(largest, u / (2 * length));
    }
    return largest;
  };
  for (const int direction : {1, -1}) {
    const double coarse = measured(direction, 1.0 / 32), fine = measured(direction, 1.0 / 64);
    RecordProperty(
        direction > 0 ? "ahead" : "behind",
        fmt::format("{:.4f} {:.4f}, closed form {:.4f}", coarse, fine, expected(direction)));
    EXPECT_LT(fine, expected(direction) + 0.01);
    EXPECT_GT(fine, 0.8 * expected(direction));
  }
}

/// Energy in a square of 2 x 2 m after a round wave has gone through its absorbing sides, from 0 to
/// 45 degrees from their normals, less what is left in the same square of ground three times as
/// wide: the square root is a mean amplitude reflected.
TEST(AbsorbingFace, ObliqueWavesAreAbsorbed) {
  const double cell = 1.0 / 20;
  const auto energy_left = [&](double half, const char* side) {
    TerrainParameters parameters =
        box(material_of(elastic(E, nu, rho)), {-half, -half, 0}, {half, half, cell}, cell);
    set_boundary(parameters, {side, side, side, side, "smooth", "smooth"});
    parameters.particles_per_cell = {2, 2, 1};
    ContinuumTerrain ground(parameters, Communicator());
    double start = 0.0, end = 0.0;
    const auto energy = [&] {
      double sum = 0.0;
      for_particles(ground, [&](Particles& particles, std::size_t p) {
        const Vector3 x = particles.position(p);
        if (std::max(std::abs(x.x()), std::abs(x.y())) > 1.0) return;
        const double v = particles.data(column::volume)[p];
        sum += v * (0.5 * rho * particles.velocity(p).squaredNorm() +
                    particles.data(column::state + field::stored_energy)[p]);
      });
      return sum;
    };
    for_particles(ground, [&](Particles& particles, std::size_t p) {
      // u = grad of a Gaussian potential: a pressure wave in all directions, without a displacement
      // that stays.
      const Vector3 x = particles.position(p);
      const double r2 = (x.x() * x.x() + x.y() * x.y()) / 0.04, e = 1e-4 * std::exp(-r2);
      for (int a = 0; a < 2; ++a) {
        particles.data(column::velocity)[4 * p + static_cast<std::size_t>(a)] = x[a] / 0.2 * e;
        for (int b = 0; b < 2; ++b)
          particles.data(column::affine)[12 * p + static_cast<std::size_t>(4 * b + a)] =
              ((a == b ? 1.0 : 0.0) / 0.2 - x[a] * x[b] / 0.2 / 0.02) * e;
      }
    });
    start = energy();
    run(ground, 2.2 / c_p);
    end = energy();
    return end / start;
  };
  const double absorbing = energy_left(1.0, "absorbing"), open = energy_left(3.0, "smooth"),
               wall = energy_left(1.0, "smooth");
  RecordProperty("energy_left", fmt::format("absorbing {:.4f}, wide ground {:.5f}, walls {:.3f}",
                                            absorbing, open, wall));
  RecordProperty("mean_reflection", fmt::format("{:.3f}", std::sqrt((absorbing - open) / wall)));
  EXPECT_LT(std::sqrt((absorbing - open) / wall), 0.15);
}

/// How far ground under its own weight moves, held by absorbing faces all around, over the
/// settlement that its weight would cause.
double unrest(double cell, bool moving) {
  TerrainParameters parameters =
      box(material_of(elastic(E, nu, rho)), {0, 0, -0.4}, {0.8, 0.4, 0}, cell);
  parameters.z = even(-0.4, 0.2, cell);
  parameters.gravity = {0, 0, -standard_gravity};
  parameters.initial_stress = true;
  set_boundary(parameters,
               {"absorbing", "absorbing", "absorbing", "absorbing", "absorbing", "free"});
  parameters.window = moving;
  ContinuumTerrain ground(parameters, Communicator());
  for (int n = 1; n <= 10; ++n) {
    if (moving) ground.follow(0.4 + 0.05 * n);
    run(ground, 0.02);
  }
  test::MaxError moved;
  for_particles(ground, [&](Particles& particles, std::size_t p) {
    const Vector3 initial(particles.data(column::initial_x)[p],
                          particles.data(column::initial_y)[p],
                          particles.data(column::initial_z)[p]);
    moved.add((particles.position(p) - initial).norm());
  });
  return moved.max() / (rho * standard_gravity * 0.4 * 0.4 / (2 * wave_modulus));
}

/// Ground stays where it is: what moves is the quadrature error of the outermost splines, and
/// vanishes with the cell; also of ground that moves on by half a metre.
TEST(AbsorbingFace, GroundAtRestIsHeld) {
  for (const bool moving : {false, true}) {
    const double coarse = unrest(0.1, moving), fine = unrest(0.05, moving);
    RecordProperty(moving ? "moving_ground" : "ground",
                   fmt::format("moved over settlement {:.2e} {:.2e}", coarse, fine));
    EXPECT_LT(coarse, 0.07);
    EXPECT_LT(fine, coarse / 1.7);
  }
}

/// A pressure on a column: the base gives way by p L/M, L the column's height, and the column is
/// compressed by p H/M on top of it.
TEST(AbsorbingFace, StaticDisplacementIsThatOfTheSpring) {
  const double height = 1.0, pressure = 100.0, cell = 0.1;
  TerrainParameters parameters =
      box(material_of(elastic(E, nu, rho)), {0, 0, 0}, {cell, cell, height}, cell);
  set_boundary(parameters, {"smooth", "smooth", "smooth", "smooth", "absorbing", "free"});
  parameters.z = even(0, height + 2 * cell, cell);
  parameters.surface = height;
  ContinuumTerrain ground(parameters, Communicator());
  const double length = height + 2 * cell;  // of the grid: Boundary
  double time = 0.0;
  while (time < 0.3) {
    const double dt = ground.stable_time_step();
    const Particles& particles = ground.groups()[0].particles;
    for (std::size_t p = 0; p < particles.size(); ++p)
      if (particles.data(column::initial_z)[p] > height - 0.5 * cell)
        ground.add_point_force({0, p}, {0, 0, -pressure * cell * cell / 4},
                               particles.position(p) + Vector3(0, 0, 0.25 * cell));
    ground.advance(dt);
    time += dt;
  }
  double top = 0.0, bottom = 0.0;
  for_particles(ground, [&](Particles& particles, std::size_t p) {
    const double initial = particles.data(column::initial_z)[p],
                 u = particles.position(p).z() - initial;
    if (initial > height - 0.5 * cell) top = u;
    if (initial < 0.5 * cell) bottom = u;
  });
  EXPECT_NEAR(-bottom / (pressure / wave_modulus * (length + 0.25 * cell)), 1.0, 0.01);
  EXPECT_NEAR(-top / (pressure / wave_modulus * (length + height - 0.25 * cell)), 1.0, 0.01);
}

/// Cells that grow by 1.15 to 1.3 on the way of a wave send nothing visible back.
TEST(GradedGrid, GradedGridTransmitsWaves) {
  for (const double growth : {1.15, 1.3}) {
    const double cell = 1.0 / 64;
    TerrainParameters parameters = bar(4.0, cell);
    parameters.x = {0.0, 4.0, cell, 0.0, 2.0, growth};
    parameters.y = parameters.z = even(0, 1.0 / 16, 1.0 / 16);
    parameters.surface = 1.0 / 16;
    ContinuumTerrain ground(parameters, Communicator());
    const Axis& x = ground.grid().axis(0);
    start_pulse(ground, 1.0, pulse_width, pulse_speed);
    // the front is in the coarse part, echoes of the grading would be on their way back
    run(ground, 1.6 / c_p);
    test::MaxError back;
    for_particles(ground, [&](Particles& particles, std::size_t p) {
      const double at = particles.position(p).x();
      if (at > 1.0 && at < 1.9) back.add(particles.velocity(p).x());
    });
    RecordProperty(fmt::format("reflected_{:.0f}", 100 * growth),
                   fmt::format("{:.4f}, longest cell {:.3f}", back.max() / pulse_speed,
                               x.length(x.cells() - 1)));
    EXPECT_LT(back.max() / pulse_speed, growth < 1.2 ? 0.01 : 0.03);
  }
}

}  // namespace
}  // namespace furrow::waves_test
