// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What the fixes property/global of a scene give to its contact models.

#include <map>
#include <string>

#include "lammps.h"

namespace furrow::coupling {

/// The values of each, in digits, by id.
std::map<std::string, std::string> global_properties(const LAMMPS_NS::LAMMPS& lammps);

}  // namespace furrow::coupling
