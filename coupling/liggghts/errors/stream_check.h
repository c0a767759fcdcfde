// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Checks that files of LIGGGHTS arrive on the disk, which LIGGGHTS does not check.

#include "lammps.h"

namespace furrow::coupling {

/// A pipe whose reader has gone is no fault. Collective.
/// @throws Error when something of the screen, the log, a fix ave/time or a dump could not be
/// written
void check_streams(const LAMMPS_NS::LAMMPS& lammps);

}  // namespace furrow::coupling
