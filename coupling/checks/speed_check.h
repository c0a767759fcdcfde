// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Do wheels and plates move at speeds that the ground and the step can follow?

#include "coupling/checks/scene_checks.h"

namespace furrow::coupling {

/// Collective. @throws InputError for a body that outruns the waves of its continuum, or passes a
/// grain in a step
void check_speeds(LAMMPS_NS::LAMMPS& lammps, const Warn& warn);

}  // namespace furrow::coupling
