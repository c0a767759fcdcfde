// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Uses of the work of a wheel on its ground (theory: resistance, eqs. 4 to 6).

#include <array>

namespace furrow {

/// Work of a wheel on all grains since the start, by its use [J]; zero unless fix grain/work counts
/// it.
///
/// press + push of GroundLosses = slide + roll + square + walls + lifted + change of kinetic, and
/// slide + roll + square = below + ahead + aside.
struct GrainWork {
  double slide = 0.0;    ///< dissipated between grains by tangential forces
  double roll = 0.0;     ///< by rolling friction
  double square = 0.0;   ///< by normal forces of the contacts
  double below = 0.0;    ///< of these three, below the track
  double ahead = 0.0;    ///< work ahead of the track, within its width
  double aside = 0.0;    ///< next to it
  double walls = 0.0;    ///< by contacts with anything but grains and the wheel
  double lifted = 0.0;   ///< against gravity
  double kinetic = 0.0;  ///< energy of their motion

  std::array<double*, 9> numbers() {
    return {&slide, &roll, &square, &below, &ahead, &aside, &walls, &lifted, &kinetic};
  }
};

/// Since the start, of all that the wheel touches, both halves of a half model [J].
///
/// The wheel's work on its ground = continuum + press + push + friction + contact_damping +
/// contact_springs. If only this wheel presses on the continuum, continuum = compaction +
/// bulldozing + kinetic + numerical + radiated; otherwise these include the work of all bodies on
/// it.
struct GroundLosses {
  double compaction = 0.0;  ///< of a continuum, by pressing down (mpm/terrain_energy.h)
  double bulldozing = 0.0;  ///< of a continuum, by all other deformation and by lifting
  double kinetic = 0.0;     ///< energy of the continuum's motion
  double numerical = 0.0;   ///< removed by the continuum's grid
  double radiated = 0.0;    ///< by waves through absorbing faces
  double continuum = 0.0;   ///< of this wheel on a continuum
  double press = 0.0;       ///< of this wheel on grains, by vertical forces
  double push = 0.0;        ///< of this wheel on grains, by horizontal forces and torques
  double friction = 0.0;    ///< of this wheel with its ground
  /// damping of its contact with a continuum; with grains, what normal springs, dampers and rolling
  /// friction take
  double contact_damping = 0.0;
  /// energy that the springs of its contact with continuum or plane hold, or held when their
  /// contacts ended; with grains, the error of the works in time
  double contact_springs = 0.0;
  GrainWork grains;
};

}  // namespace furrow
