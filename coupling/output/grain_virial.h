// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Stress of the grains by their contacts with each other, which LIGGGHTS sums only in the steps
/// that it was asked for (compute stress/atom). Contacts with walls and bodies are not in it.

#include <optional>

#include "furrow/core/types.h"
#include "lammps.h"

namespace furrow::coupling {

/// Makes the compute; before the first run. Once for all who ask.
void add_grain_virial(LAMMPS_NS::LAMMPS& lammps);

/// Asks for the last step of the run that begins.
void ask_for_grain_virial(LAMMPS_NS::LAMMPS& lammps);

/// Stress of this rank's grains, see Grains::virial. None when this step was not asked for, after
/// an interruption, and after a run without steps, whose set-up computes other forces. Collective.
std::optional<Matrix3X> grain_virial(LAMMPS_NS::LAMMPS& lammps);

}  // namespace furrow::coupling
