// SPDX-License-Identifier: GPL-2.0-or-later
// A motion in all directions that a body force is made for: the whole chain of particles, grid,
// walls and law against its closed form.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../../unit/mpm/terrain_scene.h"

namespace furrow::manufactured_test {
namespace {

using namespace testing_terrain;

constexpr double E = 1e6, nu = 0.3, rho = 1000.0, pi = 3.14159265358979323846;
constexpr double lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
const double c_p = std::sqrt((lambda + 2 * mu) / rho), omega = pi * c_p;
const Vector3 amplitude(1e-5, -0.5e-5, 0.3e-5);  // [m]

/// u = (1 - cos(omega t)) U(x), U_x = a sin(pi x) cos(pi y) cos(pi z) and so on round: smooth walls
/// hold what they must of it.
Vector3 shape(const Vector3& x) {
  const Vector3 s = (pi * x).array().sin(), c = (pi * x).array().cos();
  return amplitude.cwiseProduct(
      Vector3(s[0] * c[1] * c[2], c[0] * s[1] * c[2], c[0] * c[1] * s[2]));
}

/// b = u'' - div(sigma)/rho [m/s^2], div(sigma) = (lambda + mu) grad(div u) + mu laplace(u).
Vector3 body_force(const Vector3& x, double t) {
  const Vector3 s = (pi * x).array().sin(), c = (pi * x).array().cos(), U = shape(x);
  const Vector3 grad_div = -pi * pi * amplitude.sum() *
                           Vector3(s[0] * c[1] * c[2], c[0] * s[1] * c[2], c[0] * c[1] * s[2]);
  const Vector3 divergence =
      (1 - std::cos(omega * t)) * ((lambda + mu) * grad_div - 3 * pi * pi * mu * U);
  return omega * omega * std::cos(omega * t) * U - divergence / rho;
}

/// Root mean square of the error of the displacement over that of the displacement.
double error_of(int cells) {
  const double cell = 1.0 / cells;
  TerrainParameters parameters = box(material_of(elastic(E, nu, rho)), {0, 0, 0}, {1, 1, 1}, cell);
  parameters.boundary.fill(BoundaryKind::smooth);
  ContinuumTerrain ground(parameters, Communicator());
  const double end = 1.5 * pi / omega, dt = end / std::ceil(end / (0.4 * cell / c_p));
  for (double t = 0.0; t < end - 0.5 * dt; t += dt) {
    const Particles& particles = ground.groups()[0].particles;
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const Vector3 x = particles.position(p);
      ground.add_point_force({0, p}, rho * particles.data(column::volume)[p] * body_force(x, t), x);
    }
    ground.advance(dt);
  }
  double error = 0.0, size = 0.0;
  for_particles(ground, [&](Particles& particles, std::size_t p) {
    const Vector3 initial(particles.data(column::initial_x)[p],
                          particles.data(column::initial_y)[p],
                          particles.data(column::initial_z)[p]),
        expected = (1 - std::cos(omega * end)) * shape(initial);
    error += (particles.position(p) - initial - expected).squaredNorm();
    size += expected.squaredNorm();
  });
  return std::sqrt(error / size);
}

TEST(ManufacturedSolution, ConvergesInSecondOrder) {
  const double coarse = error_of(4), middle = error_of(8), fine = error_of(16);
  const double first = std::log2(coarse / middle), second = std::log2(middle / fine);
  RecordProperty("errors", fmt::format("{:.2e} {:.2e} {:.2e}, orders {:.2f} {:.2f}", coarse, middle,
                                       fine, first, second));
  EXPECT_LT(fine, 0.03);
  EXPECT_GT(first, 1.7);
  EXPECT_GT(second, 1.7);
}

}  // namespace
}  // namespace furrow::manufactured_test
