// SPDX-License-Identifier: GPL-2.0-or-later
#include "tests/support/membrane.h"

#include <map>

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "tests/support/checkpoints.h"
#include "tests/support/error_of.h"

namespace furrow::membrane_test {
namespace {

/// Icosahedron with every triangle split in four a number of times, nodes on the sphere.
Surface make_sphere(double radius, int refinements) {
  const double t = (1.0 + std::sqrt(5.0)) / 2.0;
  std::vector<Vector3> nodes = {{-1, t, 0}, {1, t, 0}, {-1, -t, 0}, {1, -t, 0},
                                {0, -1, t}, {0, 1, t}, {0, -1, -t}, {0, 1, -t},
                                {t, 0, -1}, {t, 0, 1}, {-t, 0, -1}, {-t, 0, 1}};
  std::vector<Vector3i> triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                     {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                     {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                     {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int level = 0; level < refinements; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [entry, fresh] =
          middles.try_emplace(std::minmax(a, b), static_cast<int>(nodes.size()));
      if (fresh)
        nodes.push_back(0.5 *
                        (nodes[static_cast<std::size_t>(a)] + nodes[static_cast<std::size_t>(b)]));
      return entry->second;
    };
    std::vector<Vector3i> finer;
    for (const Vector3i& n : triangles) {
      const int a = middle(n[0], n[1]), b = middle(n[1], n[2]), c = middle(n[2], n[0]);
      finer.insert(finer.end(), {Vector3i(n[0], a, c), Vector3i(n[1], b, a), Vector3i(n[2], c, b),
                                 Vector3i(a, b, c)});
    }
    triangles = finer;
    for (Vector3& node : nodes) node.normalize();
  }
  Surface sphere;
  sphere.triangles = triangles;
  sphere.resize(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    sphere.x.col(static_cast<Eigen::Index>(i)) = radius * nodes[i].normalized();
  return sphere;
}

double mean_radius(const Surface& surface) { return surface.x.colwise().norm().mean(); }

/// Closed form for a St Venant-Kirchhoff sphere at stretch s (virtual work, W = 4 pi R^2 h E/(1 -
/// nu) G^2, G = (s^2 - 1)/2): p = 2 h E G / ((1 - nu) R s).
double inflation_pressure(const MembraneMaterial& m, double radius, double stretch) {
  return 2.0 * m.thickness * m.young * 0.5 * (stretch * stretch - 1.0) /
         ((1.0 - m.poisson) * radius * stretch);
}

TEST(Membrane, InflatedSphereReachesTheClosedFormAndConverges) {
  const MembraneMaterial rubber{1e6, 0.3, 1e-3, 1000.0, 60.0};
  const double radius = 0.1, stretch = 1.2;
  std::vector<double> errors;
  for (int refinements : {1, 2, 3}) {
    Membrane membrane(make_sphere(radius, refinements), rubber, {});
    membrane.set_pressure(inflation_pressure(rubber, radius, stretch));
    const double dt = membrane.stable_time_step();
    for (double t = 0.0; t < 0.4; t += dt) membrane.advance(dt);
    EXPECT_LT(membrane.energy_budget().kinetic_energy,
              1e-6 * membrane.energy_budget().stored_energy);
    errors.push_back(std::abs(mean_radius(membrane.surface()) / radius / stretch - 1.0));
  }
  EXPECT_LT(errors[2], 2e-3);
  EXPECT_GT(errors[0] / errors[1], 3.0);  // second order: four times at half the size
  EXPECT_GT(errors[1] / errors[2], 3.0);
}

TEST(Membrane, FreeFlightKeepsMomentumAndEnergyBalances) {
  const MembraneMaterial rubber{1e6, 0.3, 1e-3, 1000.0, 0.0};
  Membrane membrane(make_sphere(0.1, 2), rubber, {});
  for (Eigen::Index n = 0; n < membrane.surface().v.cols(); ++n)
    membrane.surface().v.col(n) =
        Vector3(1.0, 0.5, -0.3) +
        0.8 * membrane.surface().x.col(n).cwiseProduct(Vector3(10, -3, 5));
  const EnergyBudget start = membrane.energy_budget();
  const double dt = 0.2 * membrane.stable_time_step();
  for (int i = 0; i < 5000; ++i) membrane.advance(dt);
  const EnergyBudget end = membrane.energy_budget();
  EXPECT_LT((end.momentum - start.momentum).norm(), 1e-10 * start.momentum.norm());
  EXPECT_NEAR(end.residual() / start.residual(), 1.0, 2e-3);  // leapfrog: bounded, O(dt^2)
  EXPECT_GT(end.stored_energy, 0.0);
}

TEST(Membrane, RestoreContinuesBitwise) {
  const MembraneMaterial rubber{1e6, 0.3, 1e-3, 1000.0, 5.0};
  Membrane whole(make_sphere(0.1, 1), rubber, {0}), part(make_sphere(0.1, 1), rubber, {0});
  whole.set_pressure(500.0);
  const double dt = 0.5 * whole.stable_time_step();
  for (int i = 0; i < 50; ++i) whole.advance(dt);
  test::hand_over(whole, part);
  for (int i = 0; i < 50; ++i) {
    whole.advance(dt);
    part.advance(dt);
  }
  EXPECT_EQ(whole.surface().x, part.surface().x);
  EXPECT_EQ(test::state_of(whole), test::state_of(part));
}

TEST(Membrane, RefusesImpossibleMaterials) {
  const auto message = [](MembraneMaterial m) {
    return test::error_of<InputError>([&] { Membrane(make_sphere(0.1, 0), m, {}); });
  };
  EXPECT_THAT(message({-1.0, 0.3, 1e-3, 1000.0, 0.0}),
              testing::HasSubstr("'young' is -1; allowed: a number > 0 [Pa]"));
  EXPECT_THAT(message({1e6, 0.5, 1e-3, 1000.0, 0.0}), testing::HasSubstr("'poisson' is 0.5"));
  EXPECT_THAT(message({1e6, 0.3, 0.0, 1000.0, 0.0}), testing::HasSubstr("'thickness' is 0"));
  EXPECT_THAT(message({1e6, 0.3, 1e-3, std::nan(""), 0.0}), testing::HasSubstr("'density' is nan"));
}

}  // namespace
}  // namespace furrow::membrane_test
