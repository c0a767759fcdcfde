// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Domain decomposition: every rank owns a block of cells, a rectangle along x and y over the full
/// height, and shares the columns of nodes near its sides with its neighbours.
///
/// Blocks lie in rows and columns: all blocks of a row have the same cells along y, all of a column
/// the same cells along x. So what goes along x first and then along y reaches every block.

#include <array>
#include <vector>

#include "furrow/core/checkpoint.h"
#include "furrow/core/communicator.h"
#include "furrow/mpm/grid/block_layout.h"
#include "furrow/mpm/grid/grid.h"

namespace furrow {

/// A half-open range of cells along an axis.
struct CellRange {
  int from = 0, to = 0;
  int size() const { return to - from; }
};

class Partition {
 public:
  /// Along x and y; block b of an axis has the cells bounds[b] to bounds[b + 1] - 1.
  using Bounds = std::array<std::vector<int>, 2>;
  /// Counts for x and y: a number for each layer of cells across the axis.
  using Counts = std::array<std::vector<double>, 2>;

  /// Blocks of nearly equal numbers of cells.
  Partition(const Communicator& ranks, const BlockLayout& layout, const Grid& grid);

  /// Rows and columns of nearly equal numbers of particles.
  /// @param count  particles of all ranks in the layers of cells; the same on all ranks
  Bounds balanced(const Counts& count) const;
  const Bounds& bounds() const { return bounds_; }
  void set_bounds(Bounds bounds) { bounds_ = std::move(bounds); }
  /// Restores the blocks of a run with the same layout; others keep theirs.
  /// @return whether the saved run had the same layout
  bool checkpoint(Checkpoint& state);

  const Communicator& ranks() const { return ranks_; }
  int blocks(int axis) const { return blocks_[static_cast<std::size_t>(axis)]; }
  /// Number of this rank's block along an axis.
  int own_block(int axis) const;
  /// The rank that has a block. Neighbours along y have consecutive numbers.
  int rank_of(int x_block, int y_block) const { return x_block * blocks_[1] + y_block; }
  /// The rank that has another block of this row (axis 0) or column (axis 1).
  int rank_along(int axis, int block) const {
    return axis == 0 ? rank_of(block, own_block(1)) : rank_of(own_block(0), block);
  }
  /// Number of the block along an axis that has a layer of cells.
  int block_of(int axis, int cell) const;
  /// The rank that owns a column of cells.
  int owner(int x_cell, int y_cell) const {
    return rank_of(block_of(0, x_cell), block_of(1, y_cell));
  }

  CellRange own_cells(int axis) const;
  /// Cells where this rank's particles may be between two sortings: its block and one cell on each
  /// side.
  CellRange local_cells(int axis) const;
  /// Nodes along an axis that the particles of a block may reach.
  NodeRange local_nodes(int axis, int block) const;
  NodeBlock local_nodes() const;
  /// Nodes that this rank counts in sums over all nodes; every node is owned once.
  NodeBlock owned_nodes() const { return {owned_nodes(0), owned_nodes(1)}; }

 private:
  NodeRange owned_nodes(int axis) const;

  Communicator ranks_;
  std::array<int, 2> blocks_;  // along x and y
  Bounds bounds_;
};

}  // namespace furrow
