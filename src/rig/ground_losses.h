// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Where the work of a wheel on its ground went.

namespace furrow {

/// Since the start, of all that the wheel touches, both halves of a half model [J].
///
/// The wheel's work on its ground = continuum + press + push + friction +
/// contact_damping + contact_springs. On a continuum that nothing else presses on, continuum =
/// compaction + bulldozing + kinetic + numerical + radiated; else these are of all that press on
/// it.
struct GroundLosses {
  double compaction = 0.0;  ///< of a continuum, by pressing down (mpm/terrain_energy.h)
  double bulldozing = 0.0;  ///< of a continuum, by all other deformation and by lifting
  double kinetic = 0.0;     ///< energy of the continuum's motion
  double numerical = 0.0;   ///< what the continuum's grid takes
  double radiated = 0.0;    ///< by waves through absorbing faces
  double continuum = 0.0;   ///< of this wheel on a continuum
  double press = 0.0;       ///< of this wheel on grains, by vertical forces
  double push = 0.0;        ///< of this wheel on grains, by horizontal forces and torques
  double friction = 0.0;    ///< of this wheel with its ground
  /// of its contact with a continuum; with grains, what springs and damping square to the wheel and
  /// rolling friction take
  double contact_damping = 0.0;
  /// what the springs of its contact with continuum or plane hold or have lost: those of contacts
  /// that end are let go; with grains, the error of the works in time
  double contact_springs = 0.0;
};

}  // namespace furrow
