// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Is `ground_level`, the datum of a sinkage, the level of the ground?

#include "coupling/checks/scene_checks.h"

namespace furrow::coupling {

/// Looks at the run in which a rig begins to settle, or a plate sets off; later there is a rut.
/// A continuum and a plane know their level, of grains the highest under the body counts.
/// Collective. @throws InputError for a level that is off by more than the body's own size
void check_ground_levels(LAMMPS_NS::LAMMPS& lammps, const Warn& warn);

}  // namespace furrow::coupling
