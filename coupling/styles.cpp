#include "coupling/styles.h"

#include "coupling/fix_mesh_body.h"
#include "coupling/fix_wall_gran_body.h"
#include "coupling/fix_world.h"
#include "coupling/guard.h"
#include "coupling/liggghts_access.h"

namespace furrow::coupling {

namespace {

/// Constructors throw; LIGGGHTS expects an error.
template <class FixStyle>
LAMMPS_NS::Fix* create_fix(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg) {
  FixStyle* fix = nullptr;
  guarded(*lammps->error, [&] { fix = new FixStyle(lammps, narg, arg); });
  return fix;
}

}  // namespace

void add_styles(LAMMPS_NS::LAMMPS& lammps) {
  guarded(*lammps.error, [&] { check_library(lammps); });
  add_fix_style(lammps, "furrow/world", create_fix<FixWorld>);
  add_fix_style(lammps, "mesh/body", create_fix<FixMeshBody>);
  add_fix_style(lammps, "wall/gran/body", create_fix<FixWallGranBody>);
}

}  // namespace furrow::coupling
