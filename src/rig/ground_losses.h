// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Where the work of a wheel on its ground went.

namespace furrow {

/// Since the start, of all that the wheel touches, both halves of a half model [J].
struct GroundLosses {
  double compaction = 0.0;       ///< of a continuum, by pressing down (mpm/terrain_energy.h)
  double bulldozing = 0.0;       ///< of a continuum, by all other deformation and by lifting
  double grains = 0.0;           ///< by grains: all that they took, friction on the wheel included
  double friction = 0.0;         ///< between wheel and continuum or plane
  double contact_damping = 0.0;  ///< of the contact with a continuum
  double kinetic = 0.0;          ///< energy of the continuum's motion
  double numerical = 0.0;        ///< what the continuum's grid takes
  double radiated = 0.0;         ///< by waves through absorbing faces
};

}  // namespace furrow
