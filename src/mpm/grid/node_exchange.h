// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Sums at the nodes that several ranks share.

#include <array>
#include <vector>

#include "furrow/core/checkpoint.h"
#include "furrow/core/communicator.h"
#include "furrow/mpm/grid/grid.h"
#include "furrow/mpm/grid/partition.h"

namespace furrow {

/// Traffic that a rank sent for its shared nodes since the start.
struct HaloTraffic {
  double steps = 0.0;
  double messages = 0.0;
  double bytes = 0.0;
};

/// Ranks exchange along x over the whole width of a row of blocks, then what has come out along y
/// over the whole length of a column: a node that four blocks share gets the sums of all four
/// without a message across the corner.
class NodeExchange {
 public:
  /// Adds the sums of other ranks to the nodes that are local here too; the result has the same
  /// bits on all of them. Collective.
  void add_shared_sums(Grid& grid, const Partition& partition);

  void count_step() { traffic_.steps += 1.0; }
  /// Traffic of a rank, the mean of all. Collective.
  HaloTraffic mean_traffic(const Communicator& ranks) const;
  /// Saves the traffic of all ranks as the share of rank 0. Collective.
  void checkpoint(Checkpoint& state, const Communicator& ranks);

 private:
  void add_along(int axis, Grid& grid, const Partition& partition);
  void pack(int axis, Grid& grid, const Partition& partition);
  void add_received(int axis, Grid& grid, const Partition& partition);
  HaloTraffic all_traffic(const Communicator& ranks) const;

  std::array<std::vector<Communicator::Message>, 2> messages_;  // of an axis, for each block
  std::vector<double> own_;                                     // sums of a layer of nodes
  std::vector<const double*> parts_;  // of a layer, in the order of the blocks
  HaloTraffic traffic_;
};

}  // namespace furrow
