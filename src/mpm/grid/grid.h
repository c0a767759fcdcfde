// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The background grid on three axes: sums of the particles at its nodes, and the motion of the
/// nodes. Ground that slides on a surface inside of it has two velocity fields, one for each side
/// (slide_contact.h), and ground that thin parts divide has three (divided_ground.h); otherwise
/// there is one. A rank stores only the columns of nodes that its particles reach.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "furrow/core/rank_numbers.h"
#include "furrow/core/types.h"
#include "furrow/mpm/grid/axis.h"
#include "furrow/mpm/transfer/transfer.h"

namespace furrow {

/// Sum of the particles at a node.
struct alignas(32) NodeSum {
  double total[3];  ///< momentum [N s], or force [N]
  double mass;      ///< [kg]
};

struct alignas(32) NodeMotion {
  double velocity[3];  ///< [m/s]
  double mass;         ///< [kg]; a node without mass has no velocity
};

struct alignas(32) NodeDisplacement {
  double u[4];  ///< since the grid was last cleared [m]; the fourth number is unused
};

struct NodeTotals {
  Vector3 momentum = Vector3::Zero();  ///< [N s]
  double kinetic_energy = 0.0;         ///< [J]
};

/// A half-open range of nodes along an axis.
struct NodeRange {
  int from = 0, to = 0;
  int size() const { return to > from ? to - from : 0; }
  bool contains(int node) const { return node >= from && node < to; }
  bool operator==(const NodeRange& other) const { return from == other.from && to == other.to; }
};

/// Columns of nodes along z.
struct NodeBlock {
  NodeRange x, y;
  bool contains(int i, int j) const { return x.contains(i) && y.contains(j); }
  bool operator==(const NodeBlock& other) const { return x == other.x && y == other.y; }
};

inline NodeRange overlap(const NodeRange& a, const NodeRange& b) {
  return {std::max(a.from, b.from), std::min(a.to, b.to)};
}
inline NodeBlock overlap(const NodeBlock& a, const NodeBlock& b) {
  return {overlap(a.x, b.x), overlap(a.y, b.y)};
}

class Grid {
 public:
  /// Stores no nodes before store(). @param fields  velocity fields at each node
  Grid(Axis x, Axis y, Axis z, int fields = 1);

  /// Replaces the stored nodes by those of other columns, all values zero; nothing happens when
  /// the columns stay.
  void store(const NodeBlock& columns);
  /// The columns in memory. Nodes are numbered as in the whole grid; only these may be asked for.
  const NodeBlock& stored() const { return stored_; }

  int fields() const { return fields_; }
  /// Only these columns have other fields than the first; the values of columns that leave are zero
  /// again. Without a call all columns have all fields.
  void store_copies(const NodeBlock& columns);
  /// The copy of a field gets the motion of another one, but no mass.
  void copy_motion(int i, int j, int k, int from, int to);
  const Axis& axis(int a) const { return axes_[static_cast<std::size_t>(a)]; }
  int nodes(int a) const { return axis(a).nodes(); }
  NodeBlock all_nodes() const { return {{0, nodes(0)}, {0, nodes(1)}}; }
  double shortest_cell() const;  ///< [m]

  NodeSum& sum(int i, int j, int k, int field = 0) { return sums_[index(i, j, k, field)]; }
  NodeMotion& motion(int i, int j, int k, int field = 0) { return motions_[index(i, j, k, field)]; }
  const NodeDisplacement& displacement(int i, int j, int k, int field = 0) const {
    return displacements_[index(i, j, k, field)];
  }
  /// Sums of the columns from j on in the plane i of nodes across x: four numbers a node.
  double* column_sums(int i, int j, int field) {
    return reinterpret_cast<double*>(sums_.data() + index(i, j, 0, field));
  }

  void clear_sums(const NodeBlock& block);
  /// Takes the masses; velocity = momentum/mass. The sums are zero afterwards.
  void compute_velocities(const NodeBlock& block);
  /// Velocity += dt (force/mass + gravity). The sums are zero afterwards.
  void accelerate(const NodeBlock& block, double dt, const Vector3& gravity);
  /// Displacement += dt velocity. @return totals of the nodes of `owned`
  NodeTotals move(const NodeBlock& block, const NodeBlock& owned, double dt);
  void clear_displacement(const NodeBlock& block);

  /// The axis moves along x by whole fine cells; the numbers of the nodes stay where they are in
  /// memory.
  void shift_x(int cells) { axes_[0].shift(cells); }
  /// View for kernels, valid until the grid is shifted or stores other columns.
  GridView view(int field = 0);

  /// Stored ones, of all velocity fields.
  std::size_t node_count() const { return motions_.size(); }
  /// Memory of a node [bytes].
  static constexpr std::size_t bytes_of_node =
      sizeof(NodeSum) + sizeof(NodeMotion) + sizeof(NodeDisplacement);

  /// Count of numbers that save() appends for the nodes of some columns: motion and displacement.
  std::size_t saved_length(const NodeBlock& columns) const;
  void save(RankNumbers& numbers) const;
  /// Takes from what a rank saved of its columns, from the given number on, the nodes that are
  /// stored here.
  void restore(RankNumbers& numbers, int rank, std::uint64_t first, const NodeBlock& columns);

 private:
  std::size_t index(int i, int j, int k, int field) const { return index(stored_, i, j, k, field); }
  std::size_t index(const NodeBlock& columns, int i, int j, int k, int field) const {
    return ((static_cast<std::size_t>(field * columns.x.size() + i - columns.x.from)) *
                static_cast<std::size_t>(columns.y.size()) +
            static_cast<std::size_t>(j - columns.y.from)) *
               static_cast<std::size_t>(nodes(2)) +
           static_cast<std::size_t>(k);
  }
  /// Calls visit(n) for the nodes of a block, field by field.
  template <class Visit>
  void for_nodes(const NodeBlock& block, Visit&& visit) const;

  std::array<Axis, 3> axes_;
  int fields_;
  NodeBlock stored_;
  std::optional<NodeBlock> copies_;  // columns of the other fields than the first; none: all
  std::vector<NodeSum> sums_;
  std::vector<NodeMotion> motions_;
  std::vector<NodeDisplacement> displacements_;
};

}  // namespace furrow
