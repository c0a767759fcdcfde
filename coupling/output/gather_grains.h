// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Grains of all ranks in one place, for files and pictures.

#include "io/grains.h"
#include "lammps.h"

namespace furrow::coupling {

/// All grains on rank 0, empty elsewhere. Collective.
Grains gather_grains(LAMMPS_NS::LAMMPS& lammps, double bed_level);

}  // namespace furrow::coupling
