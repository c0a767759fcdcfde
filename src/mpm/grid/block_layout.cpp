// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/grid/block_layout.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

/// Nodes along an axis of the largest of so many blocks: its cells, one more towards each
/// neighbour, and two, as many as splines reach beyond a cell.
double local_nodes(double cells, int blocks) {
  return std::ceil(cells / blocks) + std::min(blocks - 1, 2) + 2;
}

}  // namespace

double columns_of_largest(const BlockLayout& layout, double cells_x, double cells_y) {
  return local_nodes(cells_x, layout.x) * local_nodes(cells_y, layout.y);
}

BlockLayout choose_layout(int ranks, double cells_x, double cells_y) {
  BlockLayout best{ranks, 1};
  const auto columns = [&](const BlockLayout& layout) {
    return columns_of_largest(layout, cells_x, cells_y);
  };
  for (int x = ranks - 1; x >= 1; --x) {
    if (ranks % x != 0) continue;
    const BlockLayout layout{x, ranks / x};
    if (columns(layout) < columns(best)) best = layout;
  }
  return best;
}

void check_layout(const BlockLayout& layout, int ranks, const std::string& where) {
  if (layout.x * layout.y == ranks) return;
  throw InputError(where,
                   fmt::format("has {} x {} blocks on {} rank(s)", layout.x, layout.y, ranks),
                   "as many blocks as ranks",
                   "change 'blocks' or the number of ranks; without 'blocks' Furrow chooses");
}

}  // namespace furrow
