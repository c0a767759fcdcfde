// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Multiple time stepping: the terrain takes one step while the grains on its surface mesh take N
/// (theory: step, eqs. 6 and 7).

#include "furrow/core/checkpoint.h"
#include "furrow/geometry/surface.h"

namespace furrow {

/// The grains step with dt and the terrain with T = N dt, where N is the largest integer for which
/// T does not exceed the terrain's stable step. If dt changes within an interval, T is the sum of
/// the steps: terrain and grains keep the same time. Around the time t_n of the terrain the nodes
/// of the surface mesh go on with the velocity that they have,
///   x(t) = x(t_n) + (t - t_n) v   from t_n - (T - dt)/2 to t_n + (T - dt)/2,
/// and the forces on them are summed. Their mean belongs to t_n, and is the force of the terrain's
/// leapfrog step to t_n + T: of second order, with the impulse of the grains to rounding. With
/// N = 1 this is the usual step.
class Multirate {
 public:
  /// A step of the grains under the forces on the mesh. @return whether it was the last one: the
  /// terrain then takes its step of elapsed() under mean_force(), and calls begin()
  bool add(Surface& mesh, double dt);
  double elapsed() const { return elapsed_; }  ///< of the grains since begin() [s]
  Matrix3X mean_force() const { return impulse_ / elapsed_; }

  /// @param mesh   after a step of the terrain, or at the start
  /// @param stable  step of the terrain [s]
  void begin(Surface& mesh, double dt, double stable);
  bool begun() const { return interval_ > 0.0; }
  /// Stable step of the terrain when the interval began [s].
  double stable_step() const { return stable_; }

  /// @param mesh  at the terrain's particles; moved to its place within the interval
  void resume(Surface& mesh);
  void checkpoint(Checkpoint& state, Eigen::Index nodes);

 private:
  void place(Surface& mesh) const { mesh.x = x_ + offset_ * mesh.v; }

  Matrix3X x_;             // of the nodes at t_n [m]
  Matrix3X impulse_;       // of the forces since the interval began [N s]
  double interval_ = 0.0;  // T with the first step of the grains [s]
  double elapsed_ = 0.0;   // [s]
  double offset_ = 0.0;    // t - t_n [s]
  double stable_ = 0.0;    // [s]
};

}  // namespace furrow
