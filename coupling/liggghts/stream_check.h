// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// LIGGGHTS does not look whether what it writes arrives on the disk.

#include "lammps.h"

namespace furrow::coupling {

/// On the first rank, which has the streams. A pipe whose reader has gone is no fault.
/// @throws StateError when something of the screen, the log or a fix ave/time could not be written
void check_streams(const LAMMPS_NS::LAMMPS& lammps);

}  // namespace furrow::coupling
