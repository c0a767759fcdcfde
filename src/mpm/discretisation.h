// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What all parts of a terrain work on: the grid, the particles of each layer, and who computes
/// which of them.

#include <vector>

#include "mpm/grid.h"
#include "mpm/node_exchange.h"
#include "mpm/particle_group.h"
#include "mpm/partition.h"

namespace furrow {

/// The grid is replicated in size on every rank, but only the nodes of partition.local_nodes()
/// have values here; `groups` holds this rank's particles.
struct Discretisation {
  Grid grid;
  /// one for each layer, from the top; with a slide surface, first those of its inner side
  std::vector<ParticleGroup> groups;
  Partition partition;
  NodeExchange exchange = {};

  const Communicator& ranks() const { return partition.ranks(); }
  /// Completes the sums of the nodes that other ranks have too. Collective.
  void add_shared_sums() { exchange.add_shared_sums(grid, partition); }
  /// The grid as this rank's kernels may use it: particles in its block and one cell beyond.
  GridView local_view(int field = 0);
};

}  // namespace furrow
