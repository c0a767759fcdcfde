// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/data/access.h"

#include <map>

#include "coupling/liggghts/data/expose.h"
#include "input.h"
#include "modify.h"
#include "output.h"

namespace furrow::coupling {

namespace exposed {

using FixMap = std::map<std::string, FixCreator>;
using CommandMap = std::map<std::string, CommandCreator>;

FURROW_EXPOSE(ModifyFixMap, LAMMPS_NS::Modify, FixMap*, fix_map);
FURROW_EXPOSE(ModifyRestartStyles, LAMMPS_NS::Modify, char**, style_restart_global);
FURROW_EXPOSE(InputCommandMap, LAMMPS_NS::Input, CommandMap*, command_map);
FURROW_EXPOSE(InputLine, LAMMPS_NS::Input, char*, line);
FURROW_EXPOSE(InputScripts, LAMMPS_NS::Input, int, nfile);
FURROW_EXPOSE(InputCommand, LAMMPS_NS::Input, char*, command);
FURROW_EXPOSE(FixMeshMesh, LAMMPS_NS::FixMesh, LAMMPS_NS::AbstractMesh*, mesh_);
FURROW_EXPOSE(AveTimeFile, LAMMPS_NS::FixAveTime, FILE*, fp);
FURROW_EXPOSE(OutputRestartsSingle, LAMMPS_NS::Output, bool, restart_flag_single);
FURROW_EXPOSE(OutputRestartsDouble, LAMMPS_NS::Output, bool, restart_flag_double);
FURROW_EXPOSE(OutputRestartName, LAMMPS_NS::Output, char*, restart1);
FURROW_EXPOSE(OutputRestartNameA, LAMMPS_NS::Output, char*, restart2a);
FURROW_EXPOSE(OutputRestartNameB, LAMMPS_NS::Output, char*, restart2b);
FURROW_EXPOSE(HistoryKeep, LAMMPS_NS::FixContactHistoryMesh, bool**, keepflag_);

}  // namespace exposed

namespace {

exposed::FixMap& fix_styles(const LAMMPS_NS::LAMMPS& lammps) {
  return *(lammps.modify->*member(exposed::ModifyFixMap{}));
}
exposed::CommandMap& commands(const LAMMPS_NS::LAMMPS& lammps) {
  return *(lammps.input->*member(exposed::InputCommandMap{}));
}

}  // namespace

void add_fix_style(LAMMPS_NS::LAMMPS& lammps, const std::string& style, FixCreator creator) {
  fix_styles(lammps)[style] = creator;
}
void add_command(LAMMPS_NS::LAMMPS& lammps, const std::string& name, CommandCreator creator) {
  commands(lammps)[name] = creator;
}
bool has_fix_style(const LAMMPS_NS::LAMMPS& lammps, const std::string& style) {
  return fix_styles(lammps).count(style) > 0;
}
bool has_command(const LAMMPS_NS::LAMMPS& lammps, const std::string& name) {
  return commands(lammps).count(name) > 0;
}

int open_scripts(const LAMMPS_NS::LAMMPS& lammps) {
  return lammps.input->*member(exposed::InputScripts());
}

const char* current_line(const LAMMPS_NS::LAMMPS& lammps) {
  return lammps.input->*member(exposed::InputLine{});
}

std::vector<std::string> current_command(const LAMMPS_NS::LAMMPS& lammps) {
  const LAMMPS_NS::Input& input = *lammps.input;
  const char* name = input.*member(exposed::InputCommand{});
  if (!name) return {};
  std::vector<std::string> words = {name};
  words.insert(words.end(), input.arg, input.arg + input.narg);
  return words;
}

std::vector<std::string> styles_in_restart_file(const LAMMPS_NS::LAMMPS& lammps) {
  const int count = lammps.modify->nfix_restart_global;
  if (count == 0) return {};
  char** first = lammps.modify->*member(exposed::ModifyRestartStyles{});
  return {first, first + count};
}

void replace_mesh(LAMMPS_NS::FixMesh& fix, LAMMPS_NS::AbstractMesh* mesh) {
  LAMMPS_NS::AbstractMesh*& slot = fix.*member(exposed::FixMeshMesh{});
  delete slot;
  slot = mesh;
}

FILE* file_of(const LAMMPS_NS::FixAveTime& fix) { return fix.*member(exposed::AveTimeFile{}); }

std::vector<std::string> checkpoint_names(const LAMMPS_NS::LAMMPS& lammps) {
  const LAMMPS_NS::Output& output = *lammps.output;
  std::vector<std::string> names;
  if (output.*member(exposed::OutputRestartsSingle{}))
    names.emplace_back(output.*member(exposed::OutputRestartName{}));
  if (output.*member(exposed::OutputRestartsDouble{})) {
    names.emplace_back(output.*member(exposed::OutputRestartNameA{}));
    names.emplace_back(output.*member(exposed::OutputRestartNameB{}));
  }
  return names;
}

bool contact_seen(LAMMPS_NS::FixContactHistoryMesh& history, int grain, int slot) {
  return (history.*member(exposed::HistoryKeep{}))[grain][slot];
}

}  // namespace furrow::coupling
