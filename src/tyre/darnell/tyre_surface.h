// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The triangles with which a tyre touches the world, and what their forces act on.

#include <vector>

#include "furrow/bodies/wheel_hub.h"
#include "furrow/tyre/sidewall/sidewall_ring.h"
#include "furrow/tyre/darnell/tread_mesh.h"

namespace furrow {

/// The tread's mid-surface and, on each side, rows of nodes on the arcs of the sidewalls
/// (SidewallRing::arcs()). Nodes: those of the tread in its own order, then the sidewalls' ring by
/// ring, station by station, from the bead on.
///
/// A node of a sidewall is no degree of freedom. At the share s of the way from bead to tread, the
/// tread's node of that station takes the share s of its force. The rim takes 1 - s and the
/// remaining moment, so force and moment are conserved. Its velocity
///   v = s v_tread + (1 - s) V + Omega x (x - C - s (x_tread - C))
/// is the one that makes the force's power the power of what it is handed to (V, Omega, C:
/// velocity, angular velocity and centre of the rim).
class TyreSurface {
 public:
  /// @param rows of nodes on each sidewall, the bead's row included and the tread's edge excluded;
  /// 0: the tread alone
  TyreSurface(const TreadMesh& tread, const std::vector<SidewallRing>& rings, int rows);

  Surface& surface() { return surface_; }

  /// Sets positions and velocities from those of tread and rim.
  void place(const ShellNodes& tread, const std::vector<SidewallRing>& rings, const WheelHub& rim);

  /// Distributes surface().f over tread and rim.
  /// @param on_tread [N] out: one column for each node of the tread
  /// @returns what goes to the rim, of the computed part
  Wrench hand_over(const ShellNodes& tread, const std::vector<SidewallRing>& rings,
                   const WheelHub& rim, Matrix3X& on_tread) const;

 private:
  void add_tread(const TreadMesh& tread);
  void add_sidewall(const SidewallRing& ring, int first);
  void add_quad(int a, int b, int c, int d, bool along_bd);

  Surface surface_;
  Eigen::Index tread_nodes_;
  int rows_;
};

}  // namespace furrow
