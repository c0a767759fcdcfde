// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What the executable and the Python module do with a script.

#include "lammps.h"

namespace furrow::coupling {

/// Reads the script to its end. Exceptions that come through LIGGGHTS's own functions become errors
/// of the script.
void run_script(LAMMPS_NS::LAMMPS& lammps);

/// After a script that was not stopped.
void warn_without_run(LAMMPS_NS::LAMMPS& lammps);

}  // namespace furrow::coupling
