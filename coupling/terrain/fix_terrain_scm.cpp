// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/terrain/fix_terrain_scm.h"

#include <fmt/format.h>

#include "comm.h"
#include "coupling/liggghts/script.h"
#include "coupling/liggghts/style_registry.h"

namespace furrow::coupling {

const StyleRow terrain_scm_style =
    fix_style<FixTerrainScm>("terrain/scm", "scm", "terrain/fix_terrain_scm.md");

Schema FixTerrainScm::schema() {
  Schema schema("fix terrain/scm");
  declare_height_field(schema);
  declare_relief(schema);
  schema.text("card", "soil card that gives the parameters which the line does not").optional();
  declare_soil(schema);
  return schema;
}

FixTerrainScm::FixTerrainScm(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixScm(lammps, narg, arg, schema()) {
  for (const std::string& doubt : doubts(soil()))
    warn(*lmp, fmt::format("{}: {}", options().subject(), doubt));
  if (comm->me == 0 && screen)
    fmt::print(screen, "Height field: {} x {} cells of {:.4g} m, z = {:.4g} m\n", field().columns(),
               field().rows(), field().cell(), field().parameters().level);
}

}  // namespace furrow::coupling
