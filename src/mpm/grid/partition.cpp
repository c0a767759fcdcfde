// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/grid/partition.h"

#include <algorithm>
#include <numeric>

namespace furrow {

namespace {

/// Ends of stretches of cells with nearly equal sums of their numbers.
std::vector<int> equal_shares(const std::vector<double>& count, int stretches) {
  const int cells = static_cast<int>(count.size());
  const double all = std::accumulate(count.begin(), count.end(), 0.0);
  std::vector<int> bounds = {0};
  double sum = 0.0;
  for (int cell = 0; cell < cells; ++cell) {
    sum += count[static_cast<std::size_t>(cell)];
    const int done = static_cast<int>(bounds.size());
    if (done < stretches && sum >= all * done / stretches) bounds.push_back(cell + 1);
  }
  while (static_cast<int>(bounds.size()) < stretches) bounds.push_back(cells);
  bounds.push_back(cells);
  return bounds;
}

}  // namespace

Partition::Partition(const Communicator& ranks, const BlockLayout& layout, const Grid& grid)
    : ranks_(ranks), blocks_{layout.x, layout.y} {
  Counts even;
  for (std::size_t a = 0; a < 2; ++a)
    even[a].assign(static_cast<std::size_t>(grid.axis(static_cast<int>(a)).cells()), 1.0);
  bounds_ = balanced(even);
}

Partition::Bounds Partition::balanced(const Counts& count) const {
  return {equal_shares(count[0], blocks_[0]), equal_shares(count[1], blocks_[1])};
}

bool Partition::checkpoint(Checkpoint& state) {
  Bounds bounds = bounds_;
  state.values("blocks_along_x", bounds[0]);
  state.values("blocks_along_y", bounds[1]);
  const bool same = bounds[0].size() == bounds_[0].size() && bounds[1].size() == bounds_[1].size();
  if (same) bounds_ = std::move(bounds);
  return same;
}

int Partition::own_block(int axis) const {
  return axis == 0 ? ranks_.rank() / blocks_[1] : ranks_.rank() % blocks_[1];
}

int Partition::block_of(int axis, int cell) const {
  const std::vector<int>& bounds = bounds_[static_cast<std::size_t>(axis)];
  return static_cast<int>(std::upper_bound(bounds.begin() + 1, bounds.end() - 1, cell) -
                          bounds.begin()) -
         1;
}

CellRange Partition::own_cells(int axis) const {
  const std::vector<int>& bounds = bounds_[static_cast<std::size_t>(axis)];
  const auto block = static_cast<std::size_t>(own_block(axis));
  return {bounds[block], bounds[block + 1]};
}

CellRange Partition::local_cells(int axis) const {
  const NodeRange nodes = local_nodes(axis, own_block(axis));
  return {nodes.from, std::max(nodes.from, nodes.to - 2)};
}

NodeRange Partition::local_nodes(int axis, int block) const {
  const std::vector<int>& bounds = bounds_[static_cast<std::size_t>(axis)];
  const auto b = static_cast<std::size_t>(block);
  if (bounds[b] == bounds[b + 1]) return {bounds[b], bounds[b]};
  return {std::max(0, bounds[b] - 1), std::min(bounds.back(), bounds[b + 1] + 1) + 2};
}

NodeBlock Partition::local_nodes() const {
  return {local_nodes(0, own_block(0)), local_nodes(1, own_block(1))};
}

/// A node belongs to the first block to which it is local.
NodeRange Partition::owned_nodes(int axis) const {
  NodeRange mine = local_nodes(axis, own_block(axis));
  for (int block = 0; block < own_block(axis); ++block)
    mine.from = std::max(mine.from, std::min(mine.to, local_nodes(axis, block).to));
  return mine;
}

}  // namespace furrow
