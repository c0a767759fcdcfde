// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What all parts of a terrain work on: the grid, the particles of each layer, and who computes
/// which of them.

#include <vector>

#include "mpm/grid.h"
#include "mpm/particle_group.h"
#include "mpm/partition.h"

namespace furrow {

/// The grid is replicated in size on every rank, but only the nodes of partition.local_planes()
/// have values here; `groups` holds this rank's particles.
struct Discretisation {
  Grid grid;
  /// one for each layer, from the top; with a slide surface, first those of its inner side
  std::vector<ParticleGroup> groups;
  Partition partition;

  const Communicator& ranks() const { return partition.ranks(); }
  /// The grid as this rank's kernels may use it: particles in its slab and one cell beyond.
  GridView local_view(int field = 0);
};

}  // namespace furrow
