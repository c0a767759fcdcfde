// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Grains whose contacts are those of the model snow/bond.

#include "lammps.h"

namespace furrow::coupling {

/// Number of the model among LIGGGHTS's normal models, which end at 12; it must be below 64.
inline constexpr int snow_bond_id = 20;

/// True if the pair style of the scene has the model snow/bond.
bool grains_are_snow(const LAMMPS_NS::LAMMPS& lammps);

}  // namespace furrow::coupling
