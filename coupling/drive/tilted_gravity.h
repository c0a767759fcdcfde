// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A slope: the ground keeps its axes, and the gravity of all that lies on it is turned.

#include "core/types.h"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace furrow::coupling {

/// Gravity turned by an angle [rad] about y: straight down becomes (-sin, 0, -cos), and x points
/// uphill.
Vector3 tilted(const Vector3& gravity, double angle);

/// Of every continuum of the scene, in the place of its keyword's.
void tilt_gravity_of_terrain(LAMMPS_NS::LAMMPS& lammps, double angle);
/// Adds to the forces on grains what is between the gravity of each fix gravity and the turned one.
void tilt_gravity_of_grains(LAMMPS_NS::LAMMPS& lammps, double angle);

}  // namespace furrow::coupling
