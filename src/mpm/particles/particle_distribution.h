// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Order and owners of particles: in memory by their cells, and on the rank that owns the cell; and
/// the share of the ground that each rank keeps in a checkpoint.

#include <array>
#include <cstdint>
#include <vector>

#include "furrow/core/checkpoint.h"
#include "furrow/core/rank_numbers.h"
#include "furrow/mpm/grid/boundary.h"
#include "furrow/mpm/grid/discretisation.h"

namespace furrow {

class ParticleDistribution {
 public:
  /// Both must outlive the distribution; the boundary's far field moves with the planes of nodes.
  ParticleDistribution(Discretisation& discretisation, Boundary& boundary);

  /// Adds a distance [m] that particles may have travelled since the last sorting.
  void add_drift(double distance) { drift_ += distance; }
  /// True if particles may have travelled half a cell since the last sorting. This rank has the
  /// nodes for one cell.
  bool sorting_due() const;
  /// Balances the blocks of the ranks, sends every particle to the owner of its cell, and orders
  /// them by cell. Collective. @throws StateError when a particle is outside of the grid
  void sort();
  /// Changes whenever particles change their order.
  unsigned long generation() const { return generation_; }

  /// Names the first particle that is outside of the grid. @throws StateError always
  [[noreturn]] void report_outside(const ParticleGroup& group) const;

  void checkpoint_drift(Checkpoint& state) { state.value("drift", drift_); }
  /// Each rank keeps its particles by itself, as records of Particles::pack(), group after group,
  /// and then the nodes that it stores. Ranks in the same layout get them back as they had them,
  /// in the same order; others take particles by the owners of their cells, balance the blocks, and
  /// take the nodes of these. Collective.
  void checkpoint_values(Checkpoint& state, RankNumbers& numbers);

 private:
  /// Sizes of the parts of a checkpoint that the ranks have saved.
  struct Saved {
    /// numbers of each rank, for each group
    std::vector<std::vector<double>> lengths = {};
    std::vector<double> columns = {};  // of nodes, four numbers for each rank

    std::size_t ranks() const { return columns.size() / 4; }
    NodeBlock columns_of(std::size_t rank) const;
    /// Place of a rank's first node: so many numbers are its particles.
    std::uint64_t start_of_nodes(std::size_t rank) const;
  };
  void save_particles(RankNumbers& numbers) const;
  void restore(RankNumbers& numbers, const Saved& saved, bool same_layout);
  void check_numbers(RankNumbers& numbers, const Saved& saved) const;
  void read_particles(RankNumbers& numbers, const Saved& saved, std::size_t rank, bool all);
  void migrate();
  void rebalance();
  void send_along(int axis, ParticleGroup& group);
  Partition::Counts count_in_layers() const;
  /// @param of_last_sorting  by the cells of then, which a particle may have left; else by places
  void sort_by_cell(ParticleGroup& group, bool of_last_sorting);
  std::array<int, 3> cell_of(double number) const;  ///< cell of the number that a particle keeps

  Discretisation& discretisation_;
  Boundary& boundary_;
  double drift_ = 0.0;  // bound of what any particle travelled since the last sorting [m]
  unsigned long generation_ = 0;
  // Buffers of a sorting.
  std::vector<std::size_t> cell_;   // of each particle, among those of this rank
  std::vector<std::size_t> start_;  // index of the first particle of each cell
  std::vector<std::size_t> order_;
};

}  // namespace furrow
