// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Grains of all ranks in one place, for files and pictures.

#include <optional>

#include "furrow/io/formats/grains.h"
#include "lammps.h"

namespace furrow::coupling {

/// Gathers all grains on rank 0; empty elsewhere. Collective.
/// @param virial of this rank's grains, where it is known
Grains gather_grains(LAMMPS_NS::LAMMPS& lammps, double bed_level,
                     const std::optional<Matrix3X>& virial = {});

}  // namespace furrow::coupling
