// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// One side of a tyre: stations around it, each a sidewall in the plane through its bead point, the
/// axle's direction and its tread node.

#include <memory>
#include <vector>

#include "furrow/shell/shell_nodes.h"
#include "furrow/tyre/sidewall/sidewall.h"
#include "furrow/tyre/tyre_parameters.h"

namespace furrow {

/// Place of the rim: x = centre + attitude X.
struct RimPose {
  Vector3 centre = Vector3::Zero();
  Matrix3 attitude = Matrix3::Identity();
};

/// Station i has its bead point B_i on the rim and holds the tread's node i by a strip of width w,
/// its share of the tread's edge. The strip ends at the node or at the end of a link, a rigid arm
/// s = Q s_0 on the node (Q: the node's rotation). With d from B_i to the strip's end and the
/// outward axial unit vector A of the rim:
///   a = d . A,  r e_r = d - a A,  phi = angle of the tread's axial line Q A from A towards e_r.
/// The strip's plane tilts when the tread twists against the rim; its tension resists the twist.
///
/// Its potential is w W(a, r, phi) (sidewall.h). The pressure on the chord acts on the true
/// surface: quadrilaterals between bead points, ends of links and tread nodes. With the tread they
/// enclose the tyre's air, whose potential is -p V, so all forces together have a potential and
/// balance between rim and tread (theory: tyres, eq. 5).
class SidewallRing {
 public:
  /// @param side +1 or -1: where its A points along the rim's y
  /// @param edge tread nodes in the order of their angles, from the lowest point towards +x
  /// @param width of a strip [m]
  SidewallRing(std::unique_ptr<Sidewall> sidewall, const TyreParameters& tyre, int side,
               std::vector<int> edge, double width);

  /// Adds to nodes.force and .moment. @throws StateError naming side and station
  void add_forces(ShellNodes& nodes, const RimPose& rim);

  void set_pressure(double pressure) { sidewall_->set_pressure(pressure); }
  /// Potential, the sum of w W, at the last add_forces [J].
  double potential() const { return potential_; }
  /// Volume of the quadrilaterals: a third of the integral of x . n dA [m^3].
  double volume() const { return volume_; }
  double largest_chord() const { return largest_chord_; }  ///< of the length
  const std::vector<int>& edge() const { return edge_; }
  std::size_t stations() const { return edge_.size(); }
  int side() const { return side_; }
  /// Points of the sidewall at a station by the chain, in space, from bead to tread.
  Matrix3X profile(std::size_t station, const ShellNodes& nodes, const RimPose& rim);
  /// Points of the circular arc over the chord, the shape of the chain without bending stiffness.
  /// It is cheap enough for contact in every step.
  /// @param points of each station, evenly from the bead on; the tread's end is the one after them
  /// @param x [m] columns from `first` on are set, station by station
  void arcs(int points, const ShellNodes& nodes, const RimPose& rim, Matrix3X& x,
            Eigen::Index first) const;
  /// Bead point in the rim's frame [m].
  Vector3 bead(std::size_t station) const { return bead_.col(static_cast<Eigen::Index>(station)); }

 private:
  /// Place of a strip in space.
  struct Station {
    Vector3 A;
    Vector3 e_r;
    SidewallEnd end;
    Vector3 g;    // Q A
    Vector3 arm;  // [m] the link
  };
  Station locate(std::size_t station, const ShellNodes& nodes, const RimPose& rim) const;
  void add_sidewalls(ShellNodes& nodes);
  void add_pressure(const ShellNodes& nodes, const RimPose& rim);
  static void unit_pressure(const Vector3 (&x)[4], Vector3 (&force)[4]);

  std::unique_ptr<Sidewall> sidewall_;
  int side_;
  std::vector<int> edge_;
  double width_;   // [m] of a strip
  double length_;  // [m] of the sidewall
  bool linked_;
  // One column for each station
  Matrix3X bead_;     // [m] in the rim's frame
  Matrix3X link_;     // [m] in the rim's frame, as made
  Matrix3X on_node_;  // [N] on the nodes of the tread
  Matrix3X on_end_;   // [N] on the ends of the links
  std::vector<SidewallEnd> ends_;
  std::vector<SidewallResponse> responses_;
  std::vector<Station> located_;
  double potential_ = 0.0;      // [J]
  double volume_ = 0.0;         // [m^3]
  double largest_chord_ = 0.0;  // of the length
};

}  // namespace furrow
