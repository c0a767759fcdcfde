// SPDX-License-Identifier: GPL-2.0-or-later
#include "mpm/grid.h"

#include <algorithm>
#include <utility>

namespace furrow {

Grid::Grid(Axis x, Axis y, Axis z, int fields)
    : axes_{std::move(x), std::move(y), std::move(z)}, fields_(fields) {
  const std::size_t count = index(nodes(0), 0, 0, fields - 1);
  sums_.resize(count);
  motions_.resize(count);
  displacements_.resize(count);
}

double Grid::shortest_cell() const {
  return std::min({axis(0).shortest(), axis(1).shortest(), axis(2).shortest()});
}

template <class Visit>
void Grid::for_nodes(const NodeBlock& block, Visit&& visit) const {
  for (int field = 0; field < fields_; ++field)
    for (int i = block.x.from; i < block.x.to; ++i)
      for (std::size_t n = index(i, block.y.from, 0, field), end = index(i, block.y.to, 0, field);
           n < end; ++n)
        visit(n);
}

void Grid::clear_sums(const NodeBlock& block) {
  for_nodes(block, [&](std::size_t n) { sums_[n] = NodeSum{}; });
}

void Grid::compute_velocities(const NodeBlock& block) {
  for_nodes(block, [&](std::size_t n) {
    const NodeSum sum = std::exchange(sums_[n], NodeSum{});
    const double inverse = sum.mass > 0.0 ? 1.0 / sum.mass : 0.0;
    for (int a = 0; a < 3; ++a) motions_[n].velocity[a] = inverse * sum.total[a];
    motions_[n].mass = sum.mass;
  });
}

void Grid::accelerate(const NodeBlock& block, double dt, const Vector3& gravity) {
  for_nodes(block, [&](std::size_t n) {
    const NodeSum sum = std::exchange(sums_[n], NodeSum{});
    NodeMotion& node = motions_[n];
    if (!(node.mass > 0.0)) return;
    const double per_mass = dt / node.mass;
    for (int a = 0; a < 3; ++a) node.velocity[a] += per_mass * sum.total[a] + dt * gravity[a];
  });
}

NodeTotals Grid::move(const NodeBlock& block, const NodeBlock& owned, double dt) {
  for_nodes(block, [&](std::size_t n) {
    for (int a = 0; a < 3; ++a) displacements_[n].u[a] += dt * motions_[n].velocity[a];
  });
  NodeTotals totals;
  for_nodes(owned, [&](std::size_t n) {
    const NodeMotion& node = motions_[n];
    const Vector3 v(node.velocity[0], node.velocity[1], node.velocity[2]);
    totals.momentum += node.mass * v;
    totals.kinetic_energy += 0.5 * node.mass * v.squaredNorm();
  });
  return totals;
}

void Grid::clear_displacement(const NodeBlock& block) {
  for_nodes(block, [&](std::size_t n) { displacements_[n] = NodeDisplacement{}; });
}

GridView Grid::view(int field) {
  const std::size_t n = index(0, 0, 0, field);
  return {{axes_[0].view(), axes_[1].view(), axes_[2].view()},
          sums_[n].total,
          motions_[n].velocity,
          displacements_[n].u};
}

void Grid::checkpoint(Checkpoint& state, const Communicator& ranks, const NodeBlock& owned) {
  constexpr std::size_t length = numbers_in_checkpoint;
  std::vector<double> numbers(length * motions_.size(), 0.0);
  if (state.saving()) {
    for_nodes(owned, [&](std::size_t n) {
      std::copy_n(motions_[n].velocity, 3, numbers.data() + length * n);
      numbers[length * n + 3] = motions_[n].mass;
      std::copy_n(displacements_[n].u, 4, numbers.data() + length * n + 4);
    });
    ranks.sum(numbers.data(), numbers.size());
  }
  state.values("nodes", numbers.data(), numbers.size());
  if (state.saving()) return;
  for (std::size_t n = 0; n < motions_.size(); ++n) {
    const double* node = numbers.data() + length * n;
    std::copy_n(node, 3, motions_[n].velocity);
    motions_[n].mass = node[3];
    std::copy_n(node + 4, 4, displacements_[n].u);
  }
}

}  // namespace furrow
