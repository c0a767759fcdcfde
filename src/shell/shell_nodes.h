// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Nodes of a shell: six degrees of freedom each, moved by central differences.

#include <vector>

#include "furrow/core/checkpoint.h"
#include "furrow/core/types.h"

namespace furrow {

/// Leapfrog: velocities belong to half steps. Rotary inertia is the same about all axes, so a
/// node's spin obeys J dw/dt = m. The work of a force held over a step is the force times the mean
/// of the velocities before and after, which is exact for the kinetic energy.
struct ShellNodes {
  explicit ShellNodes(const Matrix3X& start);

  Matrix3X x;                 ///< [m]
  Matrix3X v;                 ///< [m/s] half a step ago
  Matrix3X w;                 ///< [rad/s] in space, half a step ago
  std::vector<Quaternion> q;  ///< rotation from the start
  VectorX mass;               ///< [kg]
  VectorX inertia;            ///< [kg m^2]
  Matrix3X free_to_move;      ///< 1, or 0 for a component that is held
  Matrix3X free_to_turn;      ///< 1, or 0
  Matrix3X force, moment;     ///< [N], [N m] of this step

  Eigen::Index count() const { return x.cols(); }
  void hold(Eigen::Index node);  ///< everything
  void kick(double dt);          ///< velocities from force and moment
  void drift(double dt);         ///< positions and rotations from velocities
  void stop();                   ///< sets all velocities to zero
  double kinetic_energy() const;
  /// Largest force on a free component [N]; moments are divided by a length.
  double largest_unbalanced(double length) const;
  void set_rotation(Eigen::Index node, const Quaternion& rotation) {
    q[static_cast<std::size_t>(node)] = rotation;
  }

  void checkpoint(Checkpoint& state);
};

}  // namespace furrow
