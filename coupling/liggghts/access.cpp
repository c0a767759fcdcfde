// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/access.h"

#include <map>

#include "coupling/liggghts/expose.h"
#include "input.h"
#include "modify.h"
#include "output.h"

namespace furrow::coupling {

namespace exposed {

using FixMap = std::map<std::string, FixCreator>;
using CommandMap = std::map<std::string, CommandCreator>;

struct ModifyFixMap {
  using type = FixMap* LAMMPS_NS::Modify::*;
  friend type member(ModifyFixMap);
};
template struct Expose<ModifyFixMap, &LAMMPS_NS::Modify::fix_map>;

struct ModifyRestartStyles {
  using type = char** LAMMPS_NS::Modify::*;
  friend type member(ModifyRestartStyles);
};
template struct Expose<ModifyRestartStyles, &LAMMPS_NS::Modify::style_restart_global>;

struct InputCommandMap {
  using type = CommandMap* LAMMPS_NS::Input::*;
  friend type member(InputCommandMap);
};
template struct Expose<InputCommandMap, &LAMMPS_NS::Input::command_map>;

struct InputLine {
  using type = char* LAMMPS_NS::Input::*;
  friend type member(InputLine);
};
template struct Expose<InputLine, &LAMMPS_NS::Input::line>;

struct InputScripts {
  using type = int LAMMPS_NS::Input::*;
  friend type member(InputScripts);
};
template struct Expose<InputScripts, &LAMMPS_NS::Input::nfile>;

struct InputCommand {
  using type = char* LAMMPS_NS::Input::*;
  friend type member(InputCommand);
};
template struct Expose<InputCommand, &LAMMPS_NS::Input::command>;

struct FixMeshMesh {
  using type = LAMMPS_NS::AbstractMesh* LAMMPS_NS::FixMesh::*;
  friend type member(FixMeshMesh);
};
template struct Expose<FixMeshMesh, &LAMMPS_NS::FixMesh::mesh_>;

struct AveTimeFile {
  using type = FILE* LAMMPS_NS::FixAveTime::*;
  friend type member(AveTimeFile);
};
template struct Expose<AveTimeFile, &LAMMPS_NS::FixAveTime::fp>;

struct OutputRestartsSingle {
  using type = bool LAMMPS_NS::Output::*;
  friend type member(OutputRestartsSingle);
};
template struct Expose<OutputRestartsSingle, &LAMMPS_NS::Output::restart_flag_single>;

struct OutputRestartsDouble {
  using type = bool LAMMPS_NS::Output::*;
  friend type member(OutputRestartsDouble);
};
template struct Expose<OutputRestartsDouble, &LAMMPS_NS::Output::restart_flag_double>;

struct OutputRestartName {
  using type = char* LAMMPS_NS::Output::*;
  friend type member(OutputRestartName);
};
template struct Expose<OutputRestartName, &LAMMPS_NS::Output::restart1>;

struct OutputRestartNameA {
  using type = char* LAMMPS_NS::Output::*;
  friend type member(OutputRestartNameA);
};
template struct Expose<OutputRestartNameA, &LAMMPS_NS::Output::restart2a>;

struct OutputRestartNameB {
  using type = char* LAMMPS_NS::Output::*;
  friend type member(OutputRestartNameB);
};
template struct Expose<OutputRestartNameB, &LAMMPS_NS::Output::restart2b>;

struct HistoryKeep {
  using type = bool** LAMMPS_NS::FixContactHistoryMesh::*;
  friend type member(HistoryKeep);
};
template struct Expose<HistoryKeep, &LAMMPS_NS::FixContactHistoryMesh::keepflag_>;

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
