// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Damping of a tread's motion relative to its rim.

#include "bodies/wheel_hub.h"
#include "shell/shell_nodes.h"

namespace furrow {

/// f = -c m (v - v_rim), m = -c J (w - w_rim) at every node, proportional to its mass m and rotary
/// inertia J, where v_rim is the velocity that the point would have if it moved with the rim as a
/// rigid body. It resists neither rolling of an undeformed tyre nor falling. The rim takes the
/// opposite of its sum.
class RimDamping {
 public:
  /// @param rate c [1/s], >= 0
  explicit RimDamping(double rate) : rate_(rate) {}

  /// Finds the forces at the present velocities and adds them to nodes.force and .moment.
  void add(ShellNodes& nodes, const WheelHub& rim);
  /// On the rim, about a centre [m], of the last add().
  Wrench reaction(const ShellNodes& nodes, const Vector3& centre) const;
  /// [W] of the forces of the last add() on nodes, with the means of the velocities before and
  /// after a kick.
  double power(const ShellNodes& nodes, const Matrix3X& v_before, const Matrix3X& w_before) const;

 private:
  double rate_;
  Matrix3X force_;   // [N], one column for each node
  Matrix3X moment_;  // [N m]
};

}  // namespace furrow
