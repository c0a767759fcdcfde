// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/transfer/transfer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "furrow/simd/dispatch.h"
#include "furrow/mpm/grid/grid.h"
#include "terrain_scene.h"
#include "tests/support/max_error.h"

namespace furrow::transfer_test {
namespace {

using testing_terrain::even;

/// Particles at random places with random motion and stress in a grid that is graded along two
/// axes.
struct Cloud {
  explicit Cloud(std::size_t count)
      : grid(Axis({0.0, 1.0, 0.1, 0.3, 0.6, 1.3}, "x"), Axis(even(-0.5, 0.5, 0.125), "y"),
             Axis({0.0, 0.8, 0.08, 0.4, 0.8, 1.2}, "z")),
        velocity(4 * count),
        affine(12 * count),
        volume(count),
        ratio(count),
        residual(8 * count, std::numeric_limits<double>::quiet_NaN()),
        gradient(9 * count) {
    grid.store(grid.all_nodes());
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0), sign(-1.0, 1.0);
    const double lower[3] = {0.0, -0.5, 0.0}, size[3] = {1.0, 1.0, 0.8};
    for (int a = 0; a < 3; ++a)
      for (std::size_t p = 0; p < count; ++p)
        position[a].push_back(lower[a] + size[a] * (0.001 + 0.998 * unit(random)));
    for (std::size_t p = 0; p < count; ++p) {
      volume[p] = 1e-6 * (1.0 + unit(random));
      ratio[p] = 0.3 + unit(random);
      for (std::size_t c = 0; c < 3; ++c) {
        velocity[4 * p + c] = sign(random);
        for (std::size_t d = 0; d < 3; ++d) affine[12 * p + 4 * d + c] = 5.0 * sign(random);
      }
    }
    for (auto& s : stress)
      for (std::size_t p = 0; p < count; ++p) s.push_back(1e5 * sign(random));
    for (std::size_t g = 0; g < 9; ++g) gradients[g] = gradient.data() + g * count;
  }
  ParticleView view() {
    ParticleView v;
    v.size = volume.size();
    moved.assign(position, position + 3);  // weights stay where the particles were
    for (std::size_t a = 0; a < 3; ++a) {
      v.quadrature_position[a] = position[a].data();
      v.position[a] = moved[a].data();
    }
    v.velocity = velocity.data();
    v.affine = affine.data();
    v.residual = residual.data();
    v.volume = volume.data();
    v.volume_ratio = ratio.data();
    for (int s = 0; s < 6; ++s) v.stress[s] = stress[s].data();
    return v;
  }
  Vector3 place(std::size_t p) const { return {position[0][p], position[1][p], position[2][p]}; }
  Vector3 node_place(int i, int j, int k) const {
    return {grid.axis(0).node(i), grid.axis(1).node(j), grid.axis(2).node(k)};
  }
  template <class Visit>
  void for_nodes(Visit visit) {
    for (int i = 0; i < grid.nodes(0); ++i)
      for (int j = 0; j < grid.nodes(1); ++j)
        for (int k = 0; k < grid.nodes(2); ++k)
          visit(grid.sum(i, j, k), grid.motion(i, j, k), node_place(i, j, k));
  }
  std::size_t give_momentum() {
    return transfer_kernels().scatter_momentum(grid.view(), view(), rho);
  }
  void find_weights(const TransferKernels& kernels = transfer_kernels()) {
    weights.resize(batches(volume.size()));
    kernels.find_weights(grid.view(), view(), weights.data());
  }
  void give_force() {
    find_weights();
    transfer_kernels().scatter_force(grid.view(), view(), weights.data());
  }
  void take_strain(double dt) {
    find_weights();
    transfer_kernels().gather_strain(grid.view(), view(), weights.data(), dt, gradients);
  }
  /// @param share  of the residual motion of the last scatter_momentum that particles keep
  void take_motion(double share = 0.0) {
    if (share == 0.0) std::fill(residual.begin(), residual.end(), 0.0);
    transfer_kernels().gather_motion(grid.view(), view(), share);
  }

  Grid grid;
  static constexpr double rho = 300.0;
  std::vector<std::vector<double>> moved;
  std::vector<double> position[3], velocity, affine, volume, ratio, residual, gradient, stress[6];
  double* gradients[9];
  std::vector<Weights> weights;
};

std::vector<double> numbers_of(Grid& grid) {
  const double* first = grid.column_sums(0, 0, 0);
  return std::vector<double>(
      first, first + 4 * static_cast<std::size_t>(grid.nodes(0) * grid.nodes(1) * grid.nodes(2)));
}

constexpr double rho = Cloud::rho, dt = 1e-3;

TEST(Transfer, AllInstructionSetsAgree) {
  std::vector<double> reference, moved;
  for (const InstructionSet set : available_instruction_sets()) {
    const auto& kernels = kernels_for<TransferKernels>(set);
    EXPECT_EQ(kernels.instruction_set, set);
    Cloud cloud(1003);  // no multiple of a batch
    Grid& grid = cloud.grid;
    const ParticleView particles = cloud.view();
    ASSERT_EQ(kernels.scatter_momentum(grid.view(), particles, rho), 0u);
    std::vector<double> nodes = numbers_of(grid);
    grid.compute_velocities(grid.all_nodes());
    kernels.gather_residual(grid.view(), particles);
    cloud.find_weights(kernels);
    kernels.scatter_force(grid.view(), particles, cloud.weights.data());
    const PointForce forces[2] = {{{0.5, 0.1, 0.3}, {1.0, -2.0, 0.5}, {0.01, 0.0, -0.02}},
                                  {{0.9, -0.4, 0.01}, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0}}};
    kernels.scatter_point_forces(grid.view(), forces, 2);
    const std::vector<double> pulled = numbers_of(grid);
    nodes.insert(nodes.end(), pulled.begin(), pulled.end());
    grid.accelerate(grid.all_nodes(), dt, {100.0, 200.0, -9800.0});
    grid.move(grid.all_nodes(), grid.all_nodes(), dt);
    kernels.gather_strain(grid.view(), particles, cloud.weights.data(), dt, cloud.gradients);
    std::vector<double> after = cloud.gradient;
    const StressWork work = kernels.stress_work(particles, cloud.gradients);
    after.push_back(work.total);
    after.push_back(work.vertical);
    PointMotion point{{0.5, 0.1, 0.3}, {}, {}, {}};
    kernels.interpolate_motion(grid.view(), &point, 1);
    after.insert(after.end(), point.displacement, point.displacement + 3);
    after.insert(after.end(), point.velocity, point.velocity + 3);
    after.insert(after.end(), point.affine, point.affine + 12);
    kernels.gather_motion(grid.view(), particles, 0.95);
    for (const auto& x : cloud.moved) after.insert(after.end(), x.begin(), x.end());
    for (std::size_t p = 0; p < particles.size; ++p)
      after.insert(after.end(), &cloud.velocity[4 * p], &cloud.velocity[4 * p] + 3);
    after.insert(after.end(), cloud.affine.begin(), cloud.affine.end());
    if (reference.empty()) {
      reference = nodes;
      moved = after;
      continue;
    }
    double largest = 0.0;
    for (const double value : reference) largest = std::max(largest, std::abs(value));
    for (std::size_t n = 0; n < nodes.size(); ++n)
      ASSERT_NEAR(nodes[n], reference[n], 1e-13 * largest) << to_string(set);
    // A node that hardly any mass reaches has a large velocity with a large relative error; what
    // particles take of it is small again.
    for (std::size_t n = 0; n < after.size(); ++n)
      ASSERT_NEAR(after[n], moved[n], 1e-9 * (1.0 + std::abs(moved[n]))) << to_string(set);
  }
}

/// A rank that stores a part of the columns gets the bits of the whole grid.
TEST(Transfer, StoredColumnsHaveTheBitsOfTheWholeGrid) {
  const NodeBlock part = {{3, 9}, {2, 8}};
  for (const InstructionSet set : available_instruction_sets()) {
    const auto& kernels = kernels_for<TransferKernels>(set);
    std::vector<std::vector<double>> nodes, taken;
    for (const bool whole : {true, false}) {
      Cloud cloud(203);
      Grid& grid = cloud.grid;
      // inside of the cells that these columns serve
      const int last[2] = {part.x.to - 2, part.y.to - 2}, first[2] = {part.x.from, part.y.from};
      for (int a = 0; a < 2; ++a)
        for (double& x : cloud.position[a]) {
          const Axis& axis = grid.axis(a);
          const double from = axis.knot(first[a]), to = axis.knot(last[a]);
          x = from + (to - from) * (x - axis.lower()) / (axis.upper() - axis.lower());
        }
      if (!whole) grid.store(part);
      EXPECT_EQ(grid.node_count(),
                static_cast<std::size_t>((whole ? grid.nodes(0) : 6) * (whole ? grid.nodes(1) : 6) *
                                         grid.nodes(2)));
      const ParticleView particles = cloud.view();
      ASSERT_EQ(kernels.scatter_momentum(grid.view(), particles, rho), 0u);
      grid.compute_velocities(part);
      kernels.gather_residual(grid.view(), particles);
      cloud.find_weights(kernels);
      kernels.scatter_force(grid.view(), particles, cloud.weights.data());
      nodes.emplace_back();
      for (int i = part.x.from; i < part.x.to; ++i)
        for (int j = part.y.from; j < part.y.to; ++j) {
          const double* sums = grid.column_sums(i, j, 0);
          nodes.back().insert(nodes.back().end(), sums, sums + 4 * grid.nodes(2));
        }
      grid.accelerate(part, dt, {100.0, 200.0, -9800.0});
      grid.move(part, part, dt);
      kernels.gather_strain(grid.view(), particles, cloud.weights.data(), dt, cloud.gradients);
      kernels.gather_motion(grid.view(), particles, 0.95);
      taken.push_back(cloud.gradient);
      for (const auto& x : cloud.moved) taken.back().insert(taken.back().end(), x.begin(), x.end());
      taken.back().insert(taken.back().end(), cloud.affine.begin(), cloud.affine.end());
    }
    EXPECT_EQ(nodes[0], nodes[1]) << to_string(set);
    EXPECT_EQ(taken[0], taken[1]) << to_string(set);
  }
}

/// On an axis of equal cells, N and G in closed form: those of unit cells inside, with G = N D^-1
/// d; in the cells at both ends the spline of the end alone differs, and G = grad N (transfer.h).
TEST(Transfer, WeightsInEqualCellsAndAtTheEnds) {
  const double h = 0.125;
  Grid grid(Axis(even(-0.5, 0.5, h), "x"), Axis(even(0.0, 0.5, h), "y"),
            Axis(even(0.0, 1.0, h), "z"));
  grid.store(grid.all_nodes());
  const double y = 0.25 + 0.3 * h, z = 0.4;  // x goes through all cells
  for (const InstructionSet set : available_instruction_sets())
    for (int n = 0; n <= 64; ++n) {
      const double x = -0.5 + n / 64.0;
      ParticleView particle;
      particle.size = 1;
      particle.quadrature_position[0] = &x;
      particle.quadrature_position[1] = &y;
      particle.quadrature_position[2] = &z;
      Weights weights;
      kernels_for<TransferKernels>(set).find_weights(grid.view(), particle, &weights);
      const int cell = std::min(n / 8, 7);
      const double f = n / 8.0 - cell, g = 1.0 - f, first = cell == 0 ? 1.0 : 0.5,
                   last = cell == 7 ? 1.0 : 0.5;
      const double N[3] = {first * g * g, 1.0 - first * g * g - last * f * f, last * f * f};
      double G[3] = {-4.0 / h * N[0] * (0.5 + f), 4.0 / h * N[1] * (0.5 - f),
                     4.0 / h * N[2] * (1.5 - f)};
      if (cell == 0 || cell == 7) {
        G[0] = -2.0 / h * first * g;
        G[2] = 2.0 / h * last * f;
        G[1] = -G[0] - G[2];
      }
      EXPECT_EQ(weights.first_node[0] / (grid.nodes(1) * grid.nodes(2)), cell) << n;
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(weights.value[0][i][0], N[i], 1e-15) << to_string(set) << ' ' << n;
        EXPECT_NEAR(weights.slope[0][i][0], G[i], 1e-15 / h * 10.0) << to_string(set) << ' ' << n;
      }
    }
}

/// 1 to 20 neighbouring particles in each of some cells: taken together, in the lanes of registers,
/// they give and take what they do one by one.
TEST(Transfer, BatchesOfACellEqualSingleParticles) {
  Cloud cloud(210);
  const double h = 0.1;  // cells of x in the fine part; those of y and z are no narrower than 0.08
  std::size_t p = 0;
  for (std::size_t n = 1; n <= 20; ++n)
    for (std::size_t of_cell = 0; of_cell < n; ++of_cell, ++p) {
      const double share = (static_cast<double>(of_cell) + 0.5) / static_cast<double>(n);
      cloud.position[0][p] = h * (static_cast<double>(n % 10) + share);
      cloud.position[1][p] = -0.5 + 0.125 * (static_cast<double>(n % 8) + 1.0 - share);
      cloud.position[2][p] = 0.08 * (static_cast<double>(n % 5) + share * share);
    }
  Grid& grid = cloud.grid;
  std::mt19937 random(8);
  std::uniform_real_distribution<double> sign(-1.0, 1.0);
  cloud.for_nodes([&](const NodeSum&, NodeMotion& node, const Vector3&) {
    for (double& v : node.velocity) v = sign(random);
  });
  for (const InstructionSet set : available_instruction_sets()) {
    const auto& kernels = kernels_for<TransferKernels>(set);
    const ParticleView all = cloud.view();
    cloud.find_weights(kernels);
    kernels.gather_strain(grid.view(), all, cloud.weights.data(), dt, cloud.gradients);
    grid.clear_sums(grid.all_nodes());
    kernels.scatter_force(grid.view(), all, cloud.weights.data());
    const std::vector<double> together = numbers_of(grid), gradient = cloud.gradient;

    grid.clear_sums(grid.all_nodes());
    Weights weights;
    for (std::size_t one = 0; one < all.size; ++one) {
      ParticleView single = all;
      single.size = 1;
      for (const double*& x : single.quadrature_position) x += one;
      for (const double*& s : single.stress) s += one;
      single.volume += one;
      single.volume_ratio += one;
      double* gradients[9];
      for (std::size_t g = 0; g < 9; ++g) gradients[g] = cloud.gradients[g] + one;
      kernels.find_weights(grid.view(), single, &weights);
      kernels.gather_strain(grid.view(), single, &weights, dt, gradients);
      kernels.scatter_force(grid.view(), single, &weights);
    }
    const std::vector<double> one_by_one = numbers_of(grid);
    double largest = 0.0;
    for (const double value : one_by_one) largest = std::max(largest, std::abs(value));
    for (std::size_t n = 0; n < together.size(); ++n)
      ASSERT_NEAR(together[n], one_by_one[n], 1e-14 * largest) << to_string(set);
    for (std::size_t n = 0; n < gradient.size(); ++n)
      ASSERT_NEAR(gradient[n], cloud.gradient[n], 1e-14 * dt / 0.08) << to_string(set) << ' ' << n;
  }
}

/// Mass, linear and angular momentum of the nodes are those of the particles: sum over nodes of x_i
/// x p_i equals the sum over particles of m (x x v + axial vector of C D), D = sum N_i d_i d_i^T.
TEST(Transfer, P2GKeepsMassAndMomenta) {
  Cloud cloud(2000);
  ASSERT_EQ(cloud.give_momentum(), 0u);
  double mass = 0.0, nodes_mass = 0.0;
  Vector3 momentum = Vector3::Zero(), angular = momentum, nodes_momentum = momentum,
          nodes_angular = momentum;
  cloud.for_nodes([&](const NodeSum& node, const NodeMotion&, const Vector3& x) {
    const Vector3 p = Eigen::Map<const Vector3>(node.total);
    nodes_mass += node.mass;
    nodes_momentum += p;
    nodes_angular += x.cross(p);
  });
  for (std::size_t p = 0; p < cloud.volume.size(); ++p) {
    const double m = rho * cloud.volume[p];
    const Vector3 x = cloud.place(p), v = Eigen::Map<const Vector3>(&cloud.velocity[4 * p]);
    mass += m;
    momentum += m * v;
    angular += m * x.cross(v);
    // The spin by its definition, node by node.
    const auto axis_weights = [&](int a, double* w, double* d) {
      const Axis& axis = cloud.grid.axis(a);
      const AxisView view = axis.view();
      const int c = axis.cell_of(x[a]);
      const double above = axis.knot(c + 1) - x[a], below = x[a] - axis.knot(c);
      w[0] = view.left[c] * above * above;
      w[2] = view.right[c] * below * below;
      w[1] = 1.0 - w[0] - w[2];
      for (int i = 0; i < 3; ++i) d[i] = axis.node(c + i) - x[a];
    };
    double w[3][3], d[3][3];
    for (int a = 0; a < 3; ++a) axis_weights(a, w[a], d[a]);
    const Matrix3 C =
        Eigen::Map<const Eigen::Matrix<double, 4, 3>>(&cloud.affine[12 * p]).topRows<3>();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) {
          const Vector3 lever(d[0][i], d[1][j], d[2][k]);
          angular += m * w[0][i] * w[1][j] * w[2][k] * lever.cross(C * lever);
        }
  }
  EXPECT_NEAR(nodes_mass / mass, 1.0, 1e-13);
  const double scale = mass;  // speeds are of the order of 1 m/s, levers of 1 m
  EXPECT_LT((nodes_momentum - momentum).norm(), 1e-12 * scale);
  EXPECT_LT((nodes_angular - angular).norm(), 1e-12 * scale);
}

/// Momentum and angular momentum of the nodes, about the origin.
std::pair<Vector3, Vector3> momenta_of(Cloud& cloud) {
  Vector3 momentum = Vector3::Zero(), angular = momentum;
  cloud.for_nodes([&](const NodeSum& node, const NodeMotion&, const Vector3& x) {
    momentum += Eigen::Map<const Vector3>(node.total);
    angular += x.cross(Eigen::Map<const Vector3>(node.total));
  });
  return {momentum, angular};
}

/// Particles that keep a share of what the nodes did not take bring the same momentum and angular
/// momentum to the next grid, and more kinetic energy than those that keep nothing.
TEST(Transfer, ResidualMotionHasNoMomentumAndNoAngularMomentum) {
  Vector3 before[2], after[2];
  double energy[2];
  for (const bool keep : {false, true}) {
    Cloud cloud(2000);
    Grid& grid = cloud.grid;
    cloud.give_momentum();
    std::tie(before[0], before[1]) = momenta_of(cloud);
    grid.compute_velocities(grid.all_nodes());
    transfer_kernels().gather_residual(grid.view(), cloud.view());
    cloud.take_motion(keep ? 0.95 : 0.0);
    cloud.give_momentum();
    std::tie(after[0], after[1]) = momenta_of(cloud);
    for (int n = 0; n < 2; ++n) EXPECT_LT((after[n] - before[n]).norm(), 1e-12);
    grid.compute_velocities(grid.all_nodes());
    energy[keep] = grid.move(grid.all_nodes(), grid.all_nodes(), dt).kinetic_energy;
  }
  EXPECT_GT(before[1].norm(), 1e-3);
  EXPECT_GT(energy[1], 1.1 * energy[0]);
}

/// The forces of any stress are in balance, and so are their moments.
TEST(Transfer, StressForcesSumToZero) {
  Cloud cloud(2000);
  cloud.give_force();
  Vector3 force = Vector3::Zero(), moment = force;
  double size = 0.0;
  cloud.for_nodes([&](const NodeSum& node, const NodeMotion&, const Vector3& x) {
    const Vector3 f = Eigen::Map<const Vector3>(node.total);
    force += f;
    moment += x.cross(f);
    size += f.norm();
    EXPECT_EQ(node.mass, 0.0);
  });
  EXPECT_LT(force.norm(), 1e-14 * size);
  EXPECT_LT(moment.norm(), 1e-14 * size);
}

/// The nodes' velocity field, linear in x, comes back as v and C on any knots, next to the walls
/// too.
TEST(Transfer, G2PReadsLinearFieldsExactly) {
  Cloud cloud(2000);
  Matrix3 L;
  L << 1.0, -2.0, 0.5, 0.3, -0.7, 2.0, -1.5, 0.2, 0.9;
  const Vector3 v0(0.3, -0.1, 0.7);
  cloud.for_nodes([&](NodeSum&, NodeMotion& node, const Vector3& x) {
    Eigen::Map<Vector3>(node.velocity) = v0 + L * x;
  });
  cloud.grid.move(cloud.grid.all_nodes(), cloud.grid.all_nodes(), dt);
  cloud.take_strain(dt);
  cloud.take_motion();
  for (std::size_t p = 0; p < cloud.volume.size(); ++p) {
    const Vector3 x = cloud.place(p), v = v0 + L * x,
                  now(cloud.moved[0][p], cloud.moved[1][p], cloud.moved[2][p]);
    PointMotion point{{x[0], x[1], x[2]}, {}, {}, {}};
    transfer_kernels().interpolate_motion(cloud.grid.view(), &point, 1);
    EXPECT_LT((Eigen::Map<const Vector3>(point.velocity) - v).norm(), 1e-13);
    EXPECT_LT((Eigen::Map<const Vector3>(point.displacement) - dt * v).norm(), 1e-15);
    EXPECT_LT((Eigen::Map<const Eigen::Matrix<double, 4, 3>>(point.affine).topRows<3>() - L).norm(),
              1e-10);
    EXPECT_LT((Eigen::Map<const Vector3>(&cloud.velocity[4 * p]) - v).norm(), 1e-13);
    EXPECT_LT((now - (x + dt * v)).norm(), 1e-15);
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        EXPECT_NEAR(cloud.gradients[3 * row + column][p], dt * L(row, column), 1e-10 * dt);
  }
}

/// sum_i f_i . v_i = - sum_p V sigma : C for any stress and any nodal velocity: what the stress
/// takes from the grid is its work.
TEST(Transfer, ForceAndVelocityGradientAreAdjoint) {
  Cloud cloud(2000);
  cloud.give_force();
  std::mt19937 random(11);
  std::uniform_real_distribution<double> sign(-1.0, 1.0);
  double power = 0.0, size = 0.0;
  cloud.for_nodes([&](const NodeSum& sum, NodeMotion& node, const Vector3&) {
    for (int a = 0; a < 3; ++a) {
      const double f = sum.total[a], v = sign(random);
      power += f * v;
      size += std::abs(f * v);
      node.velocity[a] = v;
    }
  });
  cloud.take_strain(dt);
  EXPECT_NEAR(transfer_kernels().stress_work(cloud.view(), cloud.gradients).total, -dt * power,
              1e-13 * dt * size);
}

/// A uniform stress in evenly filled cells pulls at the nodes of the boundary only, with what the
/// traction makes there: on graded knots and next to walls too. (With N_i D^-1 d_i everywhere the
/// node next to a wall is pulled by 39 % of the traction.)
TEST(Transfer, UniformStressIsInEquilibrium) {
  Cloud cloud(0);
  const double sigma[6] = {-1e5, -2e5, -3e5, 4e4, -5e4, 6e4};
  for (int i = 0; i < cloud.grid.axis(0).cells(); ++i)
    for (int j = 0; j < cloud.grid.axis(1).cells(); ++j)
      for (int k = 0; k < cloud.grid.axis(2).cells(); ++k)
        for (int n = 0; n < 8; ++n) {
          const int at[3] = {i, j, k}, half[3] = {n & 1, n >> 1 & 1, n >> 2};
          double volume = 1.0;
          for (int a = 0; a < 3; ++a) {
            const Axis& axis = cloud.grid.axis(a);
            cloud.position[a].push_back(axis.knot(at[a]) +
                                        (0.25 + 0.5 * half[a]) * axis.length(at[a]));
            volume *= 0.5 * axis.length(at[a]);
          }
          cloud.volume.push_back(volume);
          cloud.ratio.push_back(1.0);
          for (int s = 0; s < 6; ++s) cloud.stress[s].push_back(sigma[s]);
        }
  cloud.give_force();
  const auto inside = [&](int a, int i) { return i > 0 && i + 1 < cloud.grid.nodes(a); };
  test::MaxError top;
  for (int i = 0; i < cloud.grid.nodes(0); ++i)
    for (int j = 0; j < cloud.grid.nodes(1); ++j)
      for (int k = 0; k < cloud.grid.nodes(2); ++k) {
        const NodeSum& node = cloud.grid.sum(i, j, k);
        if (inside(0, i) && inside(1, j) && inside(2, k)) {
          for (const double f : node.total) EXPECT_NEAR(f, 0.0, 1e-10 * 3e5);
        }
        if (k + 1 == cloud.grid.nodes(2) && inside(0, i) && inside(1, j)) {
          const double area = cloud.grid.axis(0).extent(i) * cloud.grid.axis(1).extent(j);
          top.add((node.total[2] + sigma[2] * area) / (sigma[2] * area));
        }
      }
  // two points a cell integrate the splines along the face with that error; their sum is exact
  EXPECT_LT(top.max(), 0.2);
}

/// A force next to a particle keeps its point of action: force and moment.
TEST(Transfer, PointForceKeepsForceAndMoment) {
  Cloud cloud(1);
  const PointForce one{{0.07, 0.33, 0.02}, {3.0, -1.0, 2.0}, {0.03, -0.01, 0.04}};
  transfer_kernels().scatter_point_forces(cloud.grid.view(), &one, 1);
  Vector3 sum = Vector3::Zero(), moment = sum;
  cloud.for_nodes([&](const NodeSum& node, const NodeMotion&, const Vector3& x) {
    const Vector3 f = Eigen::Map<const Vector3>(node.total);
    sum += f;
    moment += x.cross(f);
    EXPECT_EQ(node.mass, 0.0);
  });
  const Vector3 force(3.0, -1.0, 2.0), point(0.10, 0.32, 0.06);
  EXPECT_LT((sum - force).norm(), 1e-14);
  EXPECT_LT((moment - point.cross(force)).norm(), 1e-14);
}

TEST(Transfer, ParticleOutsideIsCountedAndItsBatchIsUnchanged) {
  for (const double bad : {1.5, -0.1, std::nan(""), 1e300}) {
    Cloud cloud(200);
    cloud.position[0][70] = bad;
    EXPECT_EQ(cloud.give_momentum(), 1u) << bad;
    double mass = 0.0, others = 0.0;
    cloud.for_nodes(
        [&](const NodeSum& sum, const NodeMotion&, const Vector3&) { mass += sum.mass; });
    for (std::size_t p = 0; p < cloud.volume.size(); ++p)
      if (p < 64 || p >= 128) others += rho * cloud.volume[p];
    EXPECT_NEAR(mass, others, 1e-12 * others);
  }
}

/// Without forces, particles to grid and back leave the nodes their mass and never make kinetic
/// energy. Heavy particles: mass must not mix with velocity on the way.
TEST(Transfer, TransferKeepsNodalMassAndAddsNoKineticEnergy) {
  Cloud cloud(3000);
  for (double& volume : cloud.volume) volume *= 1e4;
  std::fill(cloud.affine.begin(), cloud.affine.end(), 0.0);
  double before = 0.0;
  for (std::size_t p = 0; p < cloud.volume.size(); ++p)
    before += 0.5 * rho * cloud.volume[p] *
              Eigen::Map<const Vector3>(&cloud.velocity[4 * p]).squaredNorm();
  std::vector<double> first_masses;
  for (int step = 0; step < 20; ++step) {
    ASSERT_EQ(cloud.give_momentum(), 0u);
    std::vector<double> masses;
    cloud.for_nodes([&](const NodeSum& node, const NodeMotion&, const Vector3&) {
      masses.push_back(node.mass);
    });
    if (step == 0) first_masses = masses;
    ASSERT_EQ(masses, first_masses);
    cloud.grid.compute_velocities(cloud.grid.all_nodes());
    const double after =
        cloud.grid.move(cloud.grid.all_nodes(), cloud.grid.all_nodes(), 0.0).kinetic_energy;
    cloud.take_motion();
    EXPECT_LE(after, before * (1.0 + 1e-14));
    before = after;
  }
}

/// A kernel, the fields of the particles that it reads, and the numbers that it gives.
struct KernelUse {
  const char* name;
  std::set<std::string> read;
  std::function<std::vector<double>(const TransferKernels&, Cloud&, const ParticleView&)> result;
};

/// NaN in all fields of the particles but those that a kernel reads.
void spoil_all_but(const std::set<std::string>& read, Cloud& cloud) {
  const auto spoil = [&](const std::string& name, std::vector<double>& values) {
    if (read.count(name) == 0)
      std::fill(values.begin(), values.end(), std::numeric_limits<double>::quiet_NaN());
  };
  for (auto& x : cloud.position) spoil("quadrature_position", x);
  for (auto& x : cloud.moved) spoil("position", x);
  for (auto& s : cloud.stress) spoil("stress", s);
  spoil("velocity", cloud.velocity);
  spoil("affine", cloud.affine);
  spoil("residual", cloud.residual);
  spoil("volume", cloud.volume);
  spoil("volume_ratio", cloud.ratio);
  spoil("gradient", cloud.gradient);
}

/// The first three of each four numbers; the last is unused.
void append_vectors(const std::vector<double>& values, std::vector<double>& result) {
  for (std::size_t n = 0; n < values.size(); n += 4)
    result.insert(result.end(), &values[n], &values[n] + 3);
}

const KernelUse kernel_uses[] = {
    {"scatter_momentum",
     {"quadrature_position", "velocity", "affine", "volume"},
     [](const TransferKernels& kernels, Cloud& cloud, const ParticleView& particles) {
       EXPECT_EQ(kernels.scatter_momentum(cloud.grid.view(), particles, Cloud::rho), 0u);
       return numbers_of(cloud.grid);
     }},
    {"scatter_force",
     {"quadrature_position", "volume", "volume_ratio", "stress"},
     [](const TransferKernels& kernels, Cloud& cloud, const ParticleView& particles) {
       cloud.find_weights(kernels);
       kernels.scatter_force(cloud.grid.view(), particles, cloud.weights.data());
       return numbers_of(cloud.grid);
     }},
    {"gather_strain",
     {"quadrature_position"},
     [](const TransferKernels& kernels, Cloud& cloud, const ParticleView& particles) {
       cloud.find_weights(kernels);
       kernels.gather_strain(cloud.grid.view(), particles, cloud.weights.data(), 1e-3,
                             cloud.gradients);
       return cloud.gradient;
     }},
    {"stress_work",
     {"volume", "volume_ratio", "stress", "gradient"},
     [](const TransferKernels& kernels, Cloud& cloud, const ParticleView& particles) {
       const StressWork work = kernels.stress_work(particles, cloud.gradients);
       return std::vector<double>{work.total, work.vertical};
     }},
    {"gather_residual",
     {"quadrature_position", "velocity", "affine"},
     [](const TransferKernels& kernels, Cloud& cloud, const ParticleView& particles) {
       kernels.gather_residual(cloud.grid.view(), particles);
       std::vector<double> result;
       append_vectors(cloud.residual, result);
       return result;
     }},
    {"gather_motion",
     {"quadrature_position", "position", "residual"},
     [](const TransferKernels& kernels, Cloud& cloud, const ParticleView& particles) {
       kernels.gather_motion(cloud.grid.view(), particles, 0.95);
       std::vector<double> result;
       for (const auto& x : cloud.moved) result.insert(result.end(), x.begin(), x.end());
       append_vectors(cloud.velocity, result);
       append_vectors(cloud.affine, result);
       return result;
     }}};

/// Fields that a kernel does not read, among them those that it writes, may be undefined.
TEST(Transfer, UnusedFieldsHaveNoEffect) {
  for (const InstructionSet set : available_instruction_sets())
    for (const KernelUse& use : kernel_uses) {
      std::vector<double> results[2];
      for (const bool spoiled : {false, true}) {
        const auto& kernels = kernels_for<TransferKernels>(set);
        Cloud cloud(203);  // no multiple of a batch
        Grid& grid = cloud.grid;
        ASSERT_EQ(cloud.give_momentum(), 0u);
        grid.compute_velocities(grid.all_nodes());
        kernels.gather_residual(grid.view(), cloud.view());
        grid.move(grid.all_nodes(), grid.all_nodes(), dt);
        cloud.take_strain(dt);
        const ParticleView particles = cloud.view();
        if (spoiled) spoil_all_but(use.read, cloud);
        results[spoiled] = use.result(kernels, cloud, particles);
      }
      for (const double value : results[0]) ASSERT_TRUE(std::isfinite(value)) << use.name;
      EXPECT_EQ(results[1], results[0]) << use.name << ", " << to_string(set);
    }
}

}  // namespace
}  // namespace furrow::transfer_test
