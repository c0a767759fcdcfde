// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/grid/grid.h"

#include <algorithm>
#include <utility>

namespace furrow {

namespace {

constexpr std::size_t saved_numbers = 8;  // of a node: velocity, mass, displacement

}  // namespace

Grid::Grid(Axis x, Axis y, Axis z, int fields)
    : axes_{std::move(x), std::move(y), std::move(z)}, fields_(fields) {}

/// Old arrays go before new ones come.
void Grid::store(const NodeBlock& columns) {
  if (columns == stored_) return;
  stored_ = columns;
  if (copies_) copies_ = NodeBlock{};
  const std::size_t count = saved_length(columns) / saved_numbers;
  const auto renew = [count](auto& values) {
    values = {};
    values.shrink_to_fit();
    values.resize(count);
  };
  renew(sums_);
  renew(motions_);
  renew(displacements_);
}

double Grid::shortest_cell() const {
  return std::min({axis(0).shortest(), axis(1).shortest(), axis(2).shortest()});
}

template <class Visit>
void Grid::for_nodes(const NodeBlock& all, Visit&& visit) const {
  for (int field = 0; field < fields_; ++field) {
    const NodeBlock block = field > 0 && copies_ ? overlap(all, *copies_) : all;
    for (int i = block.x.from; i < block.x.to; ++i)
      for (std::size_t n = index(i, block.y.from, 0, field), end = index(i, block.y.to, 0, field);
           n < end; ++n)
        visit(n);
  }
}

void Grid::store_copies(const NodeBlock& columns) {
  if (copies_)
    for (int field = 1; field < fields_; ++field)
      for (int i = copies_->x.from; i < copies_->x.to; ++i)
        for (int j = copies_->y.from; j < copies_->y.to; ++j) {
          if (columns.contains(i, j)) continue;
          for (int k = 0; k < nodes(2); ++k) {
            const std::size_t n = index(i, j, k, field);
            sums_[n] = {};
            motions_[n] = {};
            displacements_[n] = {};
          }
        }
  copies_ = overlap(columns, stored_);
}

void Grid::copy_motion(int i, int j, int k, int from, int to) {
  const std::size_t n = index(i, j, k, to), source = index(i, j, k, from);
  std::copy_n(motions_[source].velocity, 3, motions_[n].velocity);
  displacements_[n] = displacements_[source];
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
  const std::size_t n = index(stored_.x.from, stored_.y.from, 0, field);
  return {{axes_[0].view(), axes_[1].view(), axes_[2].view()},
          {stored_.x.from, stored_.y.from},
          stored_.y.size(),
          reinterpret_cast<double*>(sums_.data() + n),
          reinterpret_cast<const double*>(motions_.data() + n),
          reinterpret_cast<const double*>(displacements_.data() + n)};
}

std::size_t Grid::saved_length(const NodeBlock& columns) const {
  return saved_numbers * static_cast<std::size_t>(fields_) *
         static_cast<std::size_t>(columns.x.size()) * static_cast<std::size_t>(columns.y.size()) *
         static_cast<std::size_t>(nodes(2));
}

/// A plane of nodes across x at a time.
void Grid::save(RankNumbers& numbers) const {
  std::vector<double> plane;
  for (int field = 0; field < fields_; ++field)
    for (int i = stored_.x.from; i < stored_.x.to; ++i) {
      plane.clear();
      for (std::size_t n = index(i, stored_.y.from, 0, field),
                       end = index(i, stored_.y.to, 0, field);
           n < end; ++n) {
        plane.insert(plane.end(), motions_[n].velocity, motions_[n].velocity + 3);
        plane.push_back(motions_[n].mass);
        plane.insert(plane.end(), displacements_[n].u, displacements_[n].u + 4);
      }
      numbers.append(plane.data(), plane.size());
    }
}

void Grid::restore(RankNumbers& numbers, int rank, std::uint64_t first, const NodeBlock& columns) {
  const NodeBlock both = overlap(stored_, columns);
  if (both.x.size() == 0 || both.y.size() == 0) return;
  std::vector<double> plane(saved_length(both) / static_cast<std::size_t>(fields_ * both.x.size()));
  for (int field = 0; field < fields_; ++field)
    for (int i = both.x.from; i < both.x.to; ++i) {
      numbers.read(rank, first + saved_numbers * index(columns, i, both.y.from, 0, field),
                   plane.data(), plane.size());
      std::size_t n = index(i, both.y.from, 0, field);
      for (const double *node = plane.data(), *end = node + plane.size(); node != end;
           node += saved_numbers, ++n) {
        std::copy_n(node, 3, motions_[n].velocity);
        motions_[n].mass = node[3];
        std::copy_n(node + 4, 4, displacements_[n].u);
      }
    }
}

}  // namespace furrow
