// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/global_properties.h"

#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "coupling/base/fixes_of.h"
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

}  // namespace furrow::coupling
