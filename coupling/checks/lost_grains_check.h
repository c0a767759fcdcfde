// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Grains that leave the box are gone without an error: LIGGGHTS's default.

#include "coupling/checks/scene_checks.h"

namespace furrow::coupling {

/// Grains of all ranks. Collective.
double count_grains(const LAMMPS_NS::LAMMPS& lammps);

/// At the end of a run that began with so many grains. A bed/window removes grains on purpose.
/// Collective.
void warn_of_lost_grains(const LAMMPS_NS::LAMMPS& lammps, double at_the_start, const Warn& warn);

}  // namespace furrow::coupling
