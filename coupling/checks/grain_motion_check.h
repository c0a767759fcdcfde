// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Does one fix, and only one, move each grain?

#include "coupling/checks/scene_checks.h"
#include "fix.h"

namespace furrow::coupling {

/// LIGGGHTS's multisphere, in all its forms, moves its clumps without saying so by its flag.
bool moves_grains(const LAMMPS_NS::Fix& fix);
/// Takes all forces off a group, so that its grains are meant to stand still.
bool freezes_grains(const LAMMPS_NS::Fix& fix);

/// Warns of grains that no fix moves: they stand still, as LIGGGHTS has it. Collective.
/// @throws InputError when two fixes move one grain, which then goes twice as far; when none moves
/// any grain of a bed that a body shall press on
void check_grain_motion(const LAMMPS_NS::LAMMPS& lammps, const Warn& warn);

/// Warns of weight that does not pull down, which `vector 0 0 1` gives. Once a step was made, when
/// a gravity of variables has its value.
void check_weight(const LAMMPS_NS::LAMMPS& lammps, const Warn& warn);

}  // namespace furrow::coupling
