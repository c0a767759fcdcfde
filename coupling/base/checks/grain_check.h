// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Checks that grains have finite places, and finds the fixes that move them.

#include "fix.h"
#include "lammps.h"

namespace furrow::coupling {

/// LIGGGHTS itself ends such a run with an internal error or a crash, some steps later. This rank's
/// grains only.
/// @throws StateError naming a grain whose position or velocity is not finite
void check_grains_finite(const LAMMPS_NS::LAMMPS& lammps);
/// Checks grains between steps by their velocities alone: a position goes wrong only through its
/// velocity.
void check_velocities_finite(const LAMMPS_NS::LAMMPS& lammps);

/// LIGGGHTS's multisphere, in all its forms, moves its clumps without saying so by its flag.
bool moves_grains(const LAMMPS_NS::Fix& fix);
/// Takes all forces off a group, so that its grains are meant to stand still.
bool freezes_grains(const LAMMPS_NS::Fix& fix);

}  // namespace furrow::coupling
