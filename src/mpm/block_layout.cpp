// SPDX-License-Identifier: GPL-2.0-or-later
#include "mpm/block_layout.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"

namespace furrow {

namespace {

/// Of the largest of so many blocks along an axis: its cells, one more towards each neighbour, and
/// two, as many as splines reach beyond a cell.
double local_nodes(int cells, int blocks) {
  return (cells + blocks - 1) / blocks + std::min(blocks - 1, 2) + 2;
}

}  // namespace

BlockLayout choose_layout(int ranks, const Grid& grid) {
  BlockLayout best{ranks, 1};
  const auto columns = [&](const BlockLayout& layout) {
    return local_nodes(grid.axis(0).cells(), layout.x) *
           local_nodes(grid.axis(1).cells(), layout.y);
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
