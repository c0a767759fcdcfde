// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/data/global_properties.h"

#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "atom.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "fix_property_global.h"

namespace furrow::coupling {

std::map<std::string, std::string> global_properties(const LAMMPS_NS::LAMMPS& lammps) {
  std::map<std::string, std::string> properties;
  for (auto* fix : fixes_of<LAMMPS_NS::FixPropertyGlobal>(*lammps.modify)) {
    std::vector<double> values;
    if (fix->scalar_flag) values.push_back(fix->compute_scalar());
    for (int i = 0; fix->vector_flag && i < fix->size_vector; ++i)
      values.push_back(fix->compute_vector(i));
    for (int i = 0; fix->array_flag && i < fix->size_array_rows; ++i)
      for (int j = 0; j < fix->size_array_cols; ++j) values.push_back(fix->compute_array(i, j));
    properties[fix->id] = fmt::format("{}", fmt::join(values, " "));
  }
  return properties;
}

LAMMPS_NS::FixPropertyGlobal* property_of_types(LAMMPS_NS::LAMMPS& lammps,
                                                const std::string& name) {
  return dynamic_cast<LAMMPS_NS::FixPropertyGlobal*>(lammps.modify->find_fix_property(
      name.c_str(), "property/global", "peratomtype", lammps.atom->ntypes, 0, "furrow", false));
}

LAMMPS_NS::FixPropertyGlobal* property_of_pairs(LAMMPS_NS::LAMMPS& lammps,
                                                const std::string& name) {
  const int types = lammps.atom->ntypes;
  return dynamic_cast<LAMMPS_NS::FixPropertyGlobal*>(lammps.modify->find_fix_property(
      name.c_str(), "property/global", "peratomtypepair", types, types, "furrow", false));
}

}  // namespace furrow::coupling
