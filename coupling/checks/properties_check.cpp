// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/checks/properties_check.h"

#include <fmt/format.h>

#include "atom.h"
#include "core/error.h"
#include "coupling/liggghts/global_properties.h"
#include "fix_property_global.h"

namespace furrow::coupling {

namespace {

// Of pairs of types; LIGGGHTS looks at the elastic ones itself.
constexpr const char* not_negative[] = {"coefficientFriction", "coefficientRollingFriction",
                                        "coefficientRollingViscousDamping",
                                        "cohesionEnergyDensity"};

}  // namespace

void check_contact_properties(LAMMPS_NS::LAMMPS& lammps) {
  const int types = lammps.atom->ntypes;
  for (const char* name : not_negative) {
    auto* property = property_of_pairs(lammps, name);
    if (!property) continue;
    const double* const* values = property->get_array();
    for (int a = 0; a < types; ++a)
      for (int b = 0; b < types; ++b)
        if (!(values[a][b] >= 0.0))
          throw InputError(fmt::format("fix property/global '{}', {}", property->id, name),
                           fmt::format("is {:g} for types {} and {}", values[a][b], a + 1, b + 1),
                           "numbers >= 0");
  }
}

}  // namespace furrow::coupling
