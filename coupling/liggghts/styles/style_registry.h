// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The table of Furrow's styles. LIGGGHTS, error messages, results files and the test of the pages
/// read it.
///
/// Each style adds its row in its own source file, as LAMMPS's FixStyle macro does:
///
///   const StyleRow wheel_rigid_style =
///       fix_style<FixWheelRigid>("wheel/rigid", "wheel", "wheels/fix_wheel_rigid.md");
///
/// The rows are static objects: the table is complete before main() and constant from then on. The
/// linker must take the object file of every style, so coupling/ is an object library.

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "furrow/core/options/options.h"
#include "furrow/core/options/outputs.h"
#include "coupling/liggghts/data/access.h"
#include "coupling/liggghts/errors/errors.h"
#include "coupling/liggghts/styles/script.h"
#include "lammps.h"

namespace furrow::coupling {

/// Outputs of a style: the table of that name in its page.
struct OutputTable {
  /// "entry": f_ID[1], f_ID[2], ...; "channel": of a results file; "variable": of the script
  std::string what;
  std::vector<Channel> rows;
};

struct Style {
  std::string name;  ///< "wheel/rigid"
  /// Errors list the styles of a kind, and results files record it. "wheel": a body with a hub,
  /// which a rig can drive; "body": another body; "internal": a fix that Furrow itself makes.
  std::string kind;
  std::string page;  ///< in coupling/, "wheels/fix_wheel_rigid.md"; empty for internal styles
  Schema (*schema)();
  OutputTable (*outputs)();
  // creator of a fix, command or model; the two others are null
  FixCreator create_fix = nullptr;
  CommandCreator run_command = nullptr;
  void (*add_model)() = nullptr;
  std::vector<std::string> former_names = {};  ///< accepted with a warning
};

/// Adds a style to the table.
struct StyleRow {
  StyleRow(Style style);
};

/// All styles, sorted by name.
const std::vector<Style>& styles();
/// Finds a style by its name or a former one; null for a style that is not Furrow's.
const Style* find_style(const std::string& name);

/// The styles of some kinds as errors name them: "tyre/brick, wheel/rigid or plate/rigid".
std::string style_names(const std::vector<std::string>& kinds);

/// Makes all styles known to LIGGGHTS. @throws nothing: a library of another version is a LIGGGHTS
/// error
void add_styles(LAMMPS_NS::LAMMPS& lammps);

// ---- rows

template <class Source>
OutputTable output_table(const Outputs<Source>& outputs) {
  return {"entry", outputs.channels()};
}
inline OutputTable output_table(const OutputTable& table) { return table; }

/// Constructors throw; LIGGGHTS expects an error. A fix gets the present name of its style, also
/// where the line has a former one, because restart files identify it by that name.
template <class FixClass>
LAMMPS_NS::Fix* create_fix(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg) {
  std::vector<char*> words(arg, arg + narg);
  std::string name = find_style(arg[2])->name;
  if (name != arg[2])
    warn(*lammps, fmt::format("fix style {} is now called {}; write 'fix {} {} {}'", arg[2], name,
                              arg[0], arg[1], name));
  words[2] = name.data();
  FixClass* fix = nullptr;
  with_collective_errors(*lammps->error, [&] { fix = new FixClass(lammps, narg, words.data()); });
  return fix;
}

/// @param page  in coupling/; none for a fix that Furrow itself makes
template <class FixClass>
Style fix_style(const char* name, const char* kind, const char* page,
                std::vector<std::string> former_names = {}) {
  Style style = {name,
                 kind,
                 page,
                 [] { return FixClass::schema(); },
                 [] { return output_table(FixClass::outputs()); },
                 create_fix<FixClass>};
  style.former_names = std::move(former_names);
  return style;
}

template <class Command>
Style command_style(const char* name, const char* page) {
  Style style = {name, "command", page, Command::schema, Command::outputs};
  style.run_command = [](LAMMPS_NS::LAMMPS* lammps, int narg, char** arg) {
    with_collective_errors(*lammps->error, [&] { Command(lammps).command(narg, arg); });
  };
  return style;
}

template <class Model>
Style model_style(const char* page) {
  Style style = {Model::name, "model", page, Model::schema, [] { return OutputTable(); }};
  style.add_model = Model::add;
  return style;
}

}  // namespace furrow::coupling
