// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Do grains begin where grains can be: not in terrain, and over something that holds them?

#include "coupling/checks/scene_checks.h"

namespace furrow::coupling {

/// Before the first step of a scene. Collective.
/// @throws InputError for grains below the sheet that shall carry them
void check_grains_in_terrain(LAMMPS_NS::LAMMPS& lammps, const Warn& warn);

/// In a step, when gravity is known: grains that are pulled down, with no wall, mesh or grain that
/// stands still below them. Collective.
void warn_of_grains_without_floor(const LAMMPS_NS::LAMMPS& lammps, const Warn& warn);

}  // namespace furrow::coupling
