// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/styles.h"

#include <algorithm>

#include <fmt/format.h>

#include "coupling/base/fix_coupled_system.h"
#include "coupling/bodies/fix_mesh_body.h"
#include "coupling/bodies/fix_plate_rigid.h"
#include "coupling/bodies/fix_tyre_brick.h"
#include "coupling/bodies/fix_tyre_darnell.h"
#include "coupling/bodies/fix_wheel_rigid.h"
#include "coupling/contact/fix_contact_continuum.h"
#include "coupling/contact/fix_contact_plane.h"
#include "coupling/contact/fix_wall_gran_body.h"
#include "coupling/drive/command_run_until_steady.h"
#include "coupling/drive/fix_wheel_rig.h"
#include "coupling/grains/fix_grain_work.h"
#include "coupling/grains/fix_snow_energy.h"
#include "coupling/grains/fix_snow_sinter.h"
#include "coupling/grains/model_snow_bond.h"
#include "coupling/laboratory/fix_cell_servo.h"
#include "coupling/laboratory/fix_layer_shear.h"
#include "coupling/liggghts/errors.h"
#include "coupling/liggghts/library_check.h"
#include "coupling/liggghts/script.h"
#include "coupling/output/fix_progress.h"
#include "coupling/output/fix_terrain_history.h"
#include "coupling/output/fix_wheel_arc.h"
#include "coupling/output/fix_wheel_history.h"
#include "coupling/restart/command_read_restart.h"
#include "coupling/restart/fix_expected_states.h"
#include "coupling/terrain/command_bed.h"
#include "coupling/terrain/fix_bed_window.h"
#include "coupling/terrain/fix_terrain_continuum.h"

namespace furrow::coupling {

namespace {

/// Constructors throw; LIGGGHTS expects an error. A fix has the present name of its style, also
/// where the line says a former one: restart files know it by that.
template <class FixStyle>
LAMMPS_NS::Fix* create_fix(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg) {
  std::vector<char*> words(arg, arg + narg);
  std::string name = find_style(arg[2])->name;
  if (name != arg[2])
    warn(*lammps, fmt::format("fix style {} is now called {}; write 'fix {} {} {}'", arg[2], name,
                              arg[0], arg[1], name));
  words[2] = name.data();
  FixStyle* fix = nullptr;
  with_collective_errors(*lammps->error, [&] { fix = new FixStyle(lammps, narg, words.data()); });
  return fix;
}

template <class Command>
void run_command(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg) {
  with_collective_errors(*lammps->error, [&] { Command(lammps).command(narg, arg); });
}

template <class Source>
OutputTable as_table(const Outputs<Source>& outputs) {
  return {"entry", outputs.channels()};
}
OutputTable as_table(const OutputTable& table) { return table; }

template <class FixStyle>
Style fix(const char* name, Kind kind, const char* page,
          std::vector<std::string> former_names = {}) {
  return {name,
          kind,
          page,
          [] { return FixStyle::schema(); },
          [] { return as_table(FixStyle::outputs()); },
          create_fix<FixStyle>,
          nullptr,
          nullptr,
          std::move(former_names)};
}

template <class Command>
Style command(const char* name, const char* page) {
  return {name,
          Kind::command,
          page,
          Command::schema,
          Command::outputs,
          nullptr,
          run_command<Command>,
          nullptr,
          {}};
}

template <class Model>
Style model(const char* page) {
  return {Model::name, Kind::model, page, Model::schema, [] { return OutputTable(); }, nullptr,
          nullptr,     Model::add,  {}};
}

}  // namespace

const std::vector<Style>& styles() {
  static const std::vector<Style> table = {
      fix<FixWheelRigid>("wheel/rigid", Kind::wheel, "bodies/fix_wheel_rigid.md"),
      fix<FixTyreDarnell>("tyre/darnell", Kind::wheel, "bodies/fix_tyre_darnell.md"),
      fix<FixTyreBrick>("tyre/brick", Kind::wheel, "bodies/fix_tyre_brick.md"),
      fix<FixPlateRigid>("plate/rigid", Kind::body, "bodies/fix_plate_rigid.md"),
      fix<FixTerrainContinuum>("terrain/continuum", Kind::terrain,
                               "terrain/fix_terrain_continuum.md"),
      command<CommandBed>("bed", "terrain/command_bed.md"),
      fix<FixBedWindow>("bed/window", Kind::bed, "terrain/fix_bed_window.md"),
      fix<FixContactContinuum>("contact/continuum", Kind::contact,
                               "contact/fix_contact_continuum.md", {"contact/bodies"}),
      fix<FixContactPlane>("contact/plane", Kind::contact, "contact/fix_contact_plane.md"),
      fix<FixMeshBody>("mesh/body", Kind::mesh, "bodies/fix_mesh_body.md"),
      fix<FixWallGranBody>("wall/gran/body", Kind::wall, "contact/fix_wall_gran_body.md"),
      fix<FixGrainWork>("grain/work", Kind::bed, "grains/fix_grain_work.md"),
      model<ModelSnowBond>("grains/model_snow_bond.md"),
      fix<FixSnowSinter>("snow/sinter", Kind::snow, "grains/fix_snow_sinter.md"),
      fix<FixSnowEnergy>("snow/energy", Kind::snow, "grains/fix_snow_energy.md"),
      fix<FixWheelRig>("wheel/rig", Kind::rig, "drive/fix_wheel_rig.md"),
      command<CommandRunUntilSteady>("run_until_steady", "drive/command_run_until_steady.md"),
      fix<FixWheelHistory>("wheel/history", Kind::history, "output/fix_wheel_history.md"),
      fix<FixWheelArc>("wheel/arc", Kind::history, "output/fix_wheel_arc.md"),
      fix<FixTerrainHistory>("terrain/history", Kind::history, "output/fix_terrain_history.md"),
      command<CommandReadRestart>("read_restart", "restart/command_read_restart.md"),
      fix<FixProgress>("progress", Kind::progress, "output/fix_progress.md"),
      fix<FixCellServo>("cell/servo", Kind::laboratory, "laboratory/fix_cell_servo.md"),
      fix<FixLayerShear>("layer/shear", Kind::laboratory, "laboratory/fix_layer_shear.md"),
      fix<FixCoupledSystem>("furrow/system", Kind::internal, ""),
      fix<FixExpectedStates>("furrow/expected_states", Kind::internal, ""),
  };
  return table;
}

const Style* find_style(const std::string& name) {
  const auto found = std::find_if(styles().begin(), styles().end(), [&](const Style& style) {
    return style.name == name ||
           std::count(style.former_names.begin(), style.former_names.end(), name);
  });
  return found == styles().end() ? nullptr : &*found;
}

std::string style_names(const std::vector<Kind>& kinds) {
  std::vector<std::string> names;
  for (const Style& style : styles())
    if (std::count(kinds.begin(), kinds.end(), style.kind)) names.push_back(style.name);
  std::string text;
  for (std::size_t n = 0; n < names.size(); ++n)
    text += (n == 0 ? "" : n + 1 < names.size() ? ", " : " or ") + names[n];
  return text;
}

std::string name_of(Kind kind) {
  switch (kind) {
    case Kind::wheel:
      return "wheel";
    case Kind::body:
      return "body";
    case Kind::terrain:
      return "terrain";
    case Kind::bed:
      return "bed";
    case Kind::contact:
      return "contact";
    case Kind::mesh:
      return "mesh";
    case Kind::wall:
      return "wall";
    case Kind::rig:
      return "rig";
    case Kind::history:
      return "history";
    case Kind::progress:
      return "progress";
    case Kind::snow:
      return "snow";
    case Kind::laboratory:
      return "laboratory";
    case Kind::internal:
      return "internal";
    case Kind::command:
      return "command";
    case Kind::model:
      return "model";
  }
  return {};
}

void add_styles(LAMMPS_NS::LAMMPS& lammps) {
  with_collective_errors(*lammps.error, [&] { check_library(lammps); });
  for (const Style& style : styles()) {
    if (style.add_model) style.add_model();
    if (style.run_command) add_command(lammps, style.name, style.run_command);
    if (!style.create_fix) continue;
    add_fix_style(lammps, style.name, style.create_fix);
    for (const std::string& former : style.former_names)
      add_fix_style(lammps, former, style.create_fix);
  }
}

}  // namespace furrow::coupling
