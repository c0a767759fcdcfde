// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Run of a script, for the executable and the Python module.

#include "lammps.h"

namespace furrow::coupling {

/// Reads the script to its end. Exceptions that come through LIGGGHTS's own functions become errors
/// of the script.
void run_script(LAMMPS_NS::LAMMPS& lammps);

/// Warns of a script that ended normally without a run.
void warn_without_run(LAMMPS_NS::LAMMPS& lammps);

}  // namespace furrow::coupling
