// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/checks/properties_check.h"

#include <fmt/format.h>

#include "atom.h"
#include "core/error.h"
#include "fix_property_global.h"
#include "modify.h"

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
    auto* property = dynamic_cast<LAMMPS_NS::FixPropertyGlobal*>(lammps.modify->find_fix_property(
        name, "property/global", "peratomtypepair", types, types, "furrow", false));
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
