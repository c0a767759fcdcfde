// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Is what stands behind `run` a number of steps? LIGGGHTS takes "ten" for 0 and "1e5" for 1.

#include "lammps.h"

namespace furrow::coupling {

/// @throws InputError when a word of the command `run` that must be a whole number is none
void check_run_command(const LAMMPS_NS::LAMMPS& lammps);

}  // namespace furrow::coupling
