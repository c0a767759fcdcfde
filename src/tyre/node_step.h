// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Motion of the nodes of a tyre in a step: under forces, and damped relative to their rim.

#include <array>
#include <vector>

#include "furrow/bodies/wheel_hub.h"
#include "furrow/shell/shell_nodes.h"

namespace furrow {

/// Central differences, as ShellNodes::kick() and drift(). The damping is proportional to mass and
/// rotary inertia and acts on the motion relative to the rim (theory: tyres, eq. 7). It resists
/// neither rolling of an undeformed tyre nor falling. The rim takes the opposite of its sum.
class NodeStep {
 public:
  /// @param damping_rate c [1/s], >= 0
  explicit NodeStep(double damping_rate) : rate_(damping_rate) {}

  /// Reads masses and supports of the nodes; call it again when they change.
  void take_supports(const ShellNodes& nodes);

  /// Wrenches are about the rim's centre before the step; powers are those of forces held over the
  /// step with the means of the velocities before and after.
  struct Sums {
    Wrench internal;  ///< nodes.force and .moment
    Wrench damping;
    double contact_power = 0.0;  ///< [W]
    double damping_power = 0.0;  ///< [W]
    bool finite = true;          ///< the nodes' places afterwards
  };
  /// Moves the nodes by a step under nodes.force and .moment, contact forces and the damping.
  /// @param contact [N] one column for each node
  Sums move(ShellNodes& nodes, const Matrix3X& contact, const WheelHub& rim, double dt) const;

 private:
  double rate_;
  // Values of each node, padded
  std::vector<double> mass_, inertia_;                           // [kg], [kg m^2]
  std::array<std::vector<double>, 3> mobility_, spin_mobility_;  // inverse, or 0 where held
};

}  // namespace furrow
