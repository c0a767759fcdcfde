// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Values that the fixes property/global of a scene give to its contact models.

#include <map>
#include <string>

#include "lammps.h"

namespace LAMMPS_NS {
class FixPropertyGlobal;
}

namespace furrow::coupling {

/// Values of each property, in digits, by id.
std::map<std::string, std::string> global_properties(const LAMMPS_NS::LAMMPS& lammps);

/// The property of all types of grains, or of all pairs of types; null where a scene has none.
LAMMPS_NS::FixPropertyGlobal* property_of_types(LAMMPS_NS::LAMMPS& lammps, const std::string& name);
LAMMPS_NS::FixPropertyGlobal* property_of_pairs(LAMMPS_NS::LAMMPS& lammps, const std::string& name);

}  // namespace furrow::coupling
