// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Is LIGGGHTS's step one that the bodies can follow?

#include <string>

#include "coupling/checks/scene_checks.h"

namespace furrow::coupling {

inline constexpr double many_sub_steps = 100;  ///< beyond, a step of LIGGGHTS is a long pause

/// @throws InputError
void check_step_length(const LAMMPS_NS::LAMMPS& lammps);

/// Bodies take as many sub-steps in a step as their stable step asks for. Collective.
/// @throws InputError when they are so many that the run would never end
/// @return what is slow and the remedy, when it was warned of; else nothing
std::string check_sub_steps(LAMMPS_NS::LAMMPS& lammps, const Warn& warn);

}  // namespace furrow::coupling
