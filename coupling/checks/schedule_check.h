// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Is the run long enough for the bodies that are driven to come to their speed?

#include "coupling/checks/scene_checks.h"

namespace furrow::coupling {

/// A run may be the first of several: warnings, once for a body.
void check_schedules(LAMMPS_NS::LAMMPS& lammps, const Warn& warn);

}  // namespace furrow::coupling
