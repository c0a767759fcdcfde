// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Schedule of the remaps of particles and grid: the length of a remap interval, and which of the
/// two holds the present motion (terrain_step.h explains the scheme).

#include "furrow/core/checkpoint.h"
#include "furrow/mpm/grid/discretisation.h"

namespace furrow {

/// An interval has at most TerrainParameters::remap_interval steps, and no more than any particle
/// needs to travel a twentieth of a cell: long enough that remapping takes little energy, short
/// enough that the weights fit. The more a particle is compacted, the thinner is the ground that it
/// stands for, and the less it may travel.
class RemapControl {
 public:
  /// @param residual_share  of TransferScheme; @param wave_speed  of the undisturbed ground's
  /// slowest layer [m/s]
  RemapControl(const Discretisation& discretisation, int max_steps, double residual_share,
               double wave_speed);

  bool interval_running() const { return steps_left_ > 0; }
  bool last_step() const { return steps_left_ == 1; }
  int steps_left() const { return steps_left_; }

  /// Chooses the number of steps of dt [s] from the particles' speeds. Collective.
  void begin_interval(double dt);
  /// Counts a step of dt. Contact can make the ground faster than it was when the interval began:
  /// the interval ends early when a particle may have travelled twice what was foreseen.
  /// Collective.
  /// @return bound of what any particle travelled in the step [m]
  double count_step(double dt);

  /// True while the grid is ahead of the particles' positions and velocities.
  bool particles_lag() const { return particles_lag_; }
  void grid_moved() { particles_lag_ = true; }
  void particles_updated() { particles_lag_ = false; }
  /// Bound of the distance by which particles lag [m].
  double staleness() const { return particles_lag_ ? travel_ : 0.0; }

  /// Share of the residual motion that particles have kept since the interval began: the whole
  /// share is lost in 16 steps of cfl 0.4, or while the fastest particle travels a twentieth of a
  /// cell. Shorter steps with more transfers do not damp more.
  double residual_share() const;

  /// Largest speed of this rank's particles, at the start of the interval or seen at loaded points
  /// since [m/s].
  double largest_speed() const { return largest_speed_; }
  void raise_largest_speed(double speed);

  /// Collective.
  void checkpoint(Checkpoint& state);

 private:
  const Discretisation& discretisation_;
  int max_steps_;
  double decay_;          // ln of the share of the residual motion
  double time_of_share_;  // [s]
  double elapsed_ = 0.0;  // since the interval began [s]
  int steps_left_ = 0;
  double largest_speed_ = 0.0;  // [m/s]
  double travel_ = 0.0;         // bound of what any particle travelled in the interval [m]
  bool particles_lag_ = false;
};

}  // namespace furrow
