// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Who computes what: every rank owns a slab of cells across x, and shares the nodes near its ends
/// with its neighbours.

#include <vector>

#include "core/communicator.h"
#include "mpm/grid.h"

namespace furrow {

class Partition {
 public:
  Partition(const Communicator& ranks, int cells) : ranks_(ranks), bounds_{0, cells} {}

  /// Slabs of nearly equal numbers of particles. @param count particles of all ranks in every cell
  /// across x; the same on all ranks
  void rebalance(const std::vector<double>& count);
  int owner(int cell) const;
  const Communicator& ranks() const { return ranks_; }
  /// Cells where this rank's particles may be between two sortings: its slab and one cell on each
  /// side.
  int first_cell() const { return reach(ranks_.rank()).from; }
  int last_cell() const { return reach(ranks_.rank()).to - 3; }
  /// planes of nodes that this rank's particles may reach
  PlaneRange touched() const { return reach(ranks_.rank()); }
  /// planes that are counted here in sums over all nodes
  PlaneRange owned() const;

  /// Adds what other ranks gave to the nodes that are touched here too; the sum has the same bits
  /// on all of them.
  void sum_shared(Grid& grid) const;

 private:
  PlaneRange reach(int rank) const;

  Communicator ranks_;
  std::vector<int> bounds_;  // slab r: cells bounds_[r] to bounds_[r + 1] - 1
};

}  // namespace furrow
