// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/styles.h"

#include "coupling/terrain/command_bed.h"
#include "coupling/terrain/fix_bed_window.h"
#include "coupling/laboratory/fix_cell_servo.h"
#include "coupling/laboratory/fix_layer_shear.h"
#include "coupling/contact/fix_contact_continuum.h"
#include "coupling/contact/fix_contact_plane.h"
#include "coupling/bodies/fix_mesh_body.h"
#include "coupling/bodies/fix_plate_rigid.h"
#include "coupling/contact/fix_wall_gran_body.h"
#include "coupling/output/fix_progress.h"
#include "coupling/terrain/fix_terrain_continuum.h"
#include "coupling/output/fix_terrain_history.h"
#include "coupling/bodies/fix_tyre_darnell.h"
#include "coupling/output/fix_wheel_history.h"
#include "coupling/drive/fix_wheel_rig.h"
#include "coupling/bodies/fix_wheel_rigid.h"
#include "coupling/bodies/fix_coupled_system.h"
#include "coupling/liggghts/errors.h"
#include "coupling/liggghts/access.h"

namespace furrow::coupling {

namespace {

/// Constructors throw; LIGGGHTS expects an error.
template <class FixStyle>
LAMMPS_NS::Fix* create_fix(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg) {
  FixStyle* fix = nullptr;
  with_collective_errors(*lammps->error, [&] { fix = new FixStyle(lammps, narg, arg); });
  return fix;
}

template <class Command>
void run_command(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg) {
  with_collective_errors(*lammps->error, [&] { Command(lammps).command(narg, arg); });
}

}  // namespace

void add_styles(LAMMPS_NS::LAMMPS& lammps) {
  with_collective_errors(*lammps.error, [&] { check_library(lammps); });
  add_fix_style(lammps, "furrow/system", create_fix<FixCoupledSystem>);
  add_fix_style(lammps, "plate/rigid", create_fix<FixPlateRigid>);
  add_fix_style(lammps, "wheel/rigid", create_fix<FixWheelRigid>);
  add_fix_style(lammps, "tyre/darnell", create_fix<FixTyreDarnell>);
  add_fix_style(lammps, "contact/plane", create_fix<FixContactPlane>);
  add_fix_style(lammps, "wheel/rig", create_fix<FixWheelRig>);
  add_fix_style(lammps, "wheel/history", create_fix<FixWheelHistory>);
  add_fix_style(lammps, "terrain/continuum", create_fix<FixTerrainContinuum>);
  add_fix_style(lammps, "terrain/history", create_fix<FixTerrainHistory>);
  add_fix_style(lammps, "contact/bodies", create_fix<FixContactBodies>);
  add_fix_style(lammps, "progress", create_fix<FixProgress>);
  add_fix_style(lammps, "mesh/body", create_fix<FixMeshBody>);
  add_fix_style(lammps, "wall/gran/body", create_fix<FixWallGranBody>);
  add_fix_style(lammps, "bed/window", create_fix<FixBedWindow>);
  add_fix_style(lammps, "cell/servo", create_fix<FixCellServo>);
  add_fix_style(lammps, "layer/shear", create_fix<FixLayerShear>);
  add_command(lammps, "bed", run_command<CommandBed>);
}

}  // namespace furrow::coupling
