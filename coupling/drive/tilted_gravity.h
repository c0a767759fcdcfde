// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A slope: the ground keeps its axes, and the gravity of all that lies on it is turned.

#include "furrow/core/types.h"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace furrow::coupling {

/// Turns the gravity of every terrain of the scene, as its keyword gives it. @param tilt rotation
void tilt_gravity_of_terrain(LAMMPS_NS::LAMMPS& lammps, const Matrix3& tilt);
/// Adds to the forces on grains the difference between the turned gravity and that of each fix
/// gravity.
void tilt_gravity_of_grains(LAMMPS_NS::LAMMPS& lammps, const Matrix3& tilt);

}  // namespace furrow::coupling
