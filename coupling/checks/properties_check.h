// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Have the grains' properties the sign that their contact models take for granted?

#include "lammps.h"

namespace furrow::coupling {

/// @throws InputError for a coefficient below zero, with which friction or rolling would drive the
/// grains and cohesion push them apart
void check_contact_properties(LAMMPS_NS::LAMMPS& lammps);

}  // namespace furrow::coupling
