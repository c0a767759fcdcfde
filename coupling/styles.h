// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The table of Furrow's styles: the only place that lists them. Registration, error texts, results
/// files and the test of the pages read it.
///
/// A new fix style is its class (base/furrow_fix.h, or bodies/fix_body.h for a body), its page
/// beside it and one row in styles.cpp.

#include <string>
#include <vector>

#include "core/options.h"
#include "core/outputs.h"
#include "coupling/liggghts/access.h"
#include "lammps.h"

namespace furrow::coupling {

/// What a style is for. Errors name the styles of a kind; results files tell it.
enum class Kind {
  wheel,       ///< a body with a hub, which a rig can drive
  body,        ///< another body with a surface
  terrain,     ///< deformable terrain as a body
  bed,         ///< looks after a bed of grains
  contact,     ///< between a body and a continuum or a plane
  mesh,        ///< a LIGGGHTS mesh on a body's surface
  wall,        ///< contact of grains with such meshes
  rig,         ///< drives a wheel
  history,     ///< writes results
  progress,    ///< tells how far a run is
  snow,        ///< looks after bonds of snow
  laboratory,  ///< element tests on grains
  internal,    ///< made by Furrow itself
  command,     ///< a command, not a fix
  model,       ///< a contact model of grains, not a fix
};
std::string name_of(Kind kind);

/// What a style reports: the table of that name in its page.
struct OutputTable {
  /// "entry": f_ID[1], f_ID[2], ...; "channel": of a results file; "variable": of the script
  std::string what;
  std::vector<Channel> rows;
};

struct Style {
  std::string name;  ///< "wheel/rigid"
  Kind kind;
  std::string page;  ///< in coupling/, "bodies/fix_wheel_rigid.md"; empty for internal styles
  Schema (*schema)();
  OutputTable (*outputs)();
  // one of them, the others are null
  FixCreator create_fix;
  CommandCreator run_command;
  void (*add_model)();
  std::vector<std::string> former_names;  ///< accepted with a warning
};

const std::vector<Style>& styles();
/// By its name or a former one; null for a style that is not Furrow's.
const Style* find_style(const std::string& name);

/// The styles of some kinds as errors name them: "wheel/rigid, tyre/darnell or plate/rigid".
std::string style_names(const std::vector<Kind>& kinds);

/// Makes all styles known to LIGGGHTS. @throws nothing: a library of another version is a LIGGGHTS
/// error
void add_styles(LAMMPS_NS::LAMMPS& lammps);

}  // namespace furrow::coupling
