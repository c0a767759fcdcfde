// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Domain decomposition: every rank owns a slab of cells across x, and shares the planes of nodes
/// near its ends with its neighbours.

#include <vector>

#include "core/checkpoint.h"
#include "core/communicator.h"
#include "mpm/grid.h"

namespace furrow {

class Partition {
 public:
  Partition(const Communicator& ranks, int cells) : ranks_(ranks), bounds_{0, cells} {}

  /// Chooses slabs of nearly equal numbers of particles.
  /// @param count  particles of all ranks in every layer of cells across x; the same on all ranks
  void rebalance(const std::vector<double>& count);
  /// Restores the slabs of a run with as many ranks; others keep theirs.
  /// @return whether the saved run had as many ranks
  bool checkpoint(Checkpoint& state);
  int owner(int cell) const;  ///< the rank that owns a layer of cells across x
  const Communicator& ranks() const { return ranks_; }

  /// Cells where this rank's particles may be between two sortings: its slab and one cell on each
  /// side.
  int first_local_cell() const { return local_planes_of(ranks_.rank()).from; }
  int last_local_cell() const { return local_planes_of(ranks_.rank()).to - 3; }
  /// Planes of nodes that this rank's particles may reach.
  PlaneRange local_planes() const { return local_planes_of(ranks_.rank()); }
  /// Planes that this rank counts in sums over all nodes; every plane is owned once.
  PlaneRange owned_planes() const;

  /// Adds the sums of other ranks to the nodes that are local here too; the result has the same
  /// bits on all of them. Collective.
  void sum_shared(Grid& grid) const;

 private:
  PlaneRange local_planes_of(int rank) const;
  void sum_shared(Grid& grid, int field) const;

  Communicator ranks_;
  std::vector<int> bounds_;  // slab r: cells bounds_[r] to bounds_[r + 1] - 1
};

}  // namespace furrow
