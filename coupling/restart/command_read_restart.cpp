// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/restart/command_read_restart.h"

#include <new>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "coupling/liggghts/checkpoint_file.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "coupling/restart/fix_expected_states.h"
#include "domain.h"
#include "read_restart.h"

namespace furrow::coupling {

const StyleRow read_restart_style =
    command_style<CommandReadRestart>("read_restart", "restart/command_read_restart.md");

Schema CommandReadRestart::schema() {
  Schema schema("command read_restart");
  schema.text("file",
              "first argument, without the keyword: path of the checkpoint; `*` stands for a step "
              "and means the latest");
  schema
      .choice("check", {"checked", "unchecked"},
              "second argument, without the keyword: `unchecked` reads a file that stock LIGGGHTS "
              "wrote")
      .by_default("checked");
  return schema;
}

void CommandReadRestart::command(int narg, char** arg) {
  if (narg < 1 || narg > 2)
    throw InputError("command read_restart", fmt::format("has {} arguments", narg),
                     "read_restart <file> [unchecked]");
  std::vector<Entry> entries = {{"file", {arg[0]}}};
  if (narg == 2) entries.push_back({"check", {arg[1]}});
  const Options options = schema().read(entries);
  if (domain->box_exist)
    throw InputError("command read_restart", "comes after the simulation box was made",
                     "read_restart in the place of create_box, read_data or bed",
                     "leave out the line that makes the box");
  std::string path = find_checkpoint(*lmp, options.text("file"));
  if (options.text("check") == "checked")
    check_checkpoint(*lmp, path);
  else
    check_restart_file(*lmp, path);
  note_checkpoint_read(path);
  char* words[] = {path.data()};
  try {
    LAMMPS_NS::ReadRestart(lmp).command(1, words);
    if (options.text("check") == "checked") FixExpectedStates::add_if_needed(*lmp);
  } catch (const std::bad_alloc&) {  // a length of 1e18 grains
    throw StateError(
        fmt::format("checkpoint '{}' is damaged: it needs more memory than the machine has", path));
  }
}

}  // namespace furrow::coupling
