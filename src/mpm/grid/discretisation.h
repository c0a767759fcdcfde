// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Common data of all parts of a terrain: the grid, the particles of each layer, and which rank
/// computes which of them.

#include <optional>
#include <utility>
#include <vector>

#include "furrow/mpm/grid/grid.h"
#include "furrow/mpm/grid/node_exchange.h"
#include "furrow/mpm/particles/particle_group.h"
#include "furrow/mpm/grid/partition.h"

namespace furrow {

/// Columns of nodes of all ranks.
struct AwakeNodes {
  std::vector<NodeBlock> all;     ///< nodes that computed particles reach
  std::vector<NodeBlock> moving;  ///< nodes that are not held
};

/// `grid` stores the nodes of partition.local_nodes(); `groups` holds this rank's particles.
struct Discretisation {
  Grid grid;
  /// one for each layer, from the top; with a slide surface, first those of its inner side; with
  /// thin parts, so for each field
  std::vector<ParticleGroup> groups;
  Partition partition;
  NodeExchange exchange = {};
  std::optional<AwakeNodes> awake_nodes = {};  ///< of active_ground.h; without: all

  const Communicator& ranks() const { return partition.ranks(); }
  /// Calls visit(local, owned) for blocks that together are the nodes that computed particles
  /// reach.
  template <class Visit>
  void for_awake_nodes(Visit&& visit) const {
    for_blocks(awake_nodes ? &awake_nodes->all : nullptr, visit);
  }
  /// Calls visit(local, owned) for the nodes of these that are not held.
  template <class Visit>
  void for_moving_nodes(Visit&& visit) const {
    for_blocks(awake_nodes ? &awake_nodes->moving : nullptr, visit);
  }
  /// Completes the sums of the nodes that other ranks have too. Collective.
  void add_shared_sums() { exchange.add_shared_sums(grid, partition); }
  /// The grid as this rank's kernels may use it: particles in its block and one cell beyond.
  GridView local_view(int field = 0);
  /// Nodes of blocks that change lose their values.
  void set_bounds(Partition::Bounds bounds) {
    partition.set_bounds(std::move(bounds));
    grid.store(partition.local_nodes());
  }

 private:
  template <class Visit>
  void for_blocks(const std::vector<NodeBlock>* blocks, Visit&& visit) const {
    const NodeBlock local = partition.local_nodes(), owned = partition.owned_nodes();
    if (!blocks) {
      visit(local, owned);
      return;
    }
    for (const NodeBlock& block : *blocks) visit(overlap(block, local), overlap(block, owned));
  }
};

}  // namespace furrow
