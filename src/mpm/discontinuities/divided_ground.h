// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Ground on both sides of thin parts, which the grid does not move together (theory: continuum,
/// thin parts).
///
/// Nodes beside a thin part have one copy for the ground before it and one for the ground behind
/// it; the copies do not interact, because the part lies between them. All other nodes have one
/// motion. Copies are the velocity fields of the grid. A particle uses the field of its region of
/// space next to the nearest part, or field 0 away from parts. At nodes without copies the sums of
/// all fields are added to those of field 0, and its motion is copied back: only nodes that
/// particles near parts reach are visited. At a node that divides two regions, any third field has
/// the copy before the part.
///
/// Particles change their field when they are sorted; nodes are divided where the parts are when a
/// remap interval begins.

#include <cstdint>
#include <vector>

#include "furrow/core/checkpoint.h"
#include "furrow/geometry/thin_parts.h"
#include "furrow/mpm/grid/boundary.h"
#include "furrow/mpm/grid/discretisation.h"

namespace furrow {

class DividedGround {
 public:
  /// Velocity fields: enough for parts in any ring or row.
  static constexpr int fields = 3;
  /// Cells: ground of both sides of a thicker part reaches no common node.
  static constexpr double largest_thickness = 2.5;

  /// Parts of a surface that are thin enough to divide ground.
  /// @param cell  where the surface is [m]
  static std::vector<ThinPart> parts_of(const Surface& surface, double cell);

  /// @param boundary  the far field of an absorbing face is that of ground of one piece: its nodes
  /// are not divided
  DividedGround(Discretisation& discretisation, const FaceArray<BoundaryKind>& boundary);

  /// Thin parts for the next step; surface and parts must live until then. Not collective.
  void divide_by(const Surface& surface, const std::vector<ThinPart>& parts);
  void end_step() {
    bodies_.clear();
    speed_ = 0.0;
  }
  /// Speed of the fastest node of the surfaces with thin parts [m/s].
  double speed_of_parts() const { return speed_; }
  /// True while particles near the parts have no fields yet.
  bool sorting_due() const { return !sorted_ && !bodies_.empty(); }

  /// Gives all particles of this rank their fields. Not collective.
  void sort();
  /// Divides nodes by the parts, before particles go to the grid. Not collective.
  void begin_interval();
  /// Adds the sums of linked fields, which are no separate copies, to those of the node. Not
  /// collective.
  void join_sums();
  /// Gives copies of a divided node its motion. Not collective.
  void copy_motion();

  /// Saves or restores the divided nodes, which all ranks keep.
  void checkpoint(Checkpoint& state);
  /// Links nodes after particles and nodes have been restored.
  void resume() { link(); }

 private:
  struct BodyParts {
    const Surface* surface;
    const std::vector<ThinPart>* parts;
  };
  /// The part next to a node or cell.
  struct NearPart {
    double distance;
    std::uint32_t body, part;
  };
  struct Box {
    std::array<int, 3> from, to;
    std::size_t size() const;
    bool empty() const;
    bool contains(int i, int j, int k) const;
    std::size_t index(int i, int j, int k) const;
    void include(const Box& other);
  };
  /// A node that divides two regions.
  struct DividedNode {
    std::int16_t before, behind;  // fields; the same: not divided
  };
  struct Link {
    int i, j, k, from, to;
  };
  Box cells_near(const BodyParts& body, const ThinPart& part, int margin) const;
  template <class Visit>
  void for_divided_nodes(Visit&& visit) const;
  void link();
  bool is_absorbing(int axis, int node) const;
  int field_at(int i, int j, int k, int field) const;

  Discretisation& discretisation_;
  FaceArray<BoundaryKind> boundary_;
  std::vector<BodyParts> bodies_;
  double speed_ = 0.0;
  bool sorted_ = false;
  Box box_ = {};  // of nodes_
  std::vector<DividedNode> nodes_;
  std::vector<Link> links_;
};

}  // namespace furrow
