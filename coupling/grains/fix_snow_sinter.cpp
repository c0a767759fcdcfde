// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/grains/fix_snow_sinter.h"

#include "atom.h"
#include "coupling/base/checks/require_unique.h"
#include "coupling/grains/model_snow_bond.h"
#include "coupling/liggghts/styles/style_registry.h"

namespace furrow::coupling {

const StyleRow snow_sinter_style =
    fix_style<FixSnowSinter>("snow/sinter", "snow", "grains/fix_snow_sinter.md");

FixSnowSinter::FixSnowSinter(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FurrowFix(lammps, narg, arg, schema()) {
  require_unique<FixSnowSinter>(*modify, options().subject(), "sinters clusters",
                                "one fix snow/sinter at a time",
                                [](FixSnowSinter&) { return true; });
}

void FixSnowSinter::init() {
  collectively([&] { ModelSnowBond::require(*lmp, name(), "that it could sinter"); });
}

bool FixSnowSinter::sinters(int i, int j) const {
  return (atom->mask[i] & groupbit) && (atom->mask[j] & groupbit);
}

}  // namespace furrow::coupling
