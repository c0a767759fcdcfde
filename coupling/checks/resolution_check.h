// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Is continuum terrain large enough, and fine enough, for what presses on it?

#include "coupling/checks/scene_checks.h"

namespace furrow::coupling {

/// @throws InputError for terrain narrower than the body, or cells that cannot show its shape
void check_ground_under_bodies(const LAMMPS_NS::LAMMPS& lammps, const Warn& warn);

}  // namespace furrow::coupling
