// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/access.h"

#include <filesystem>

#include <map>

#include <unistd.h>

#include <fmt/format.h>

#include "core/error.h"
#include "fix_wall_gran.h"
#include "input.h"
#include "modify.h"
#include "tri_mesh.h"
#include "universe.h"

namespace furrow::coupling {

namespace {

// An explicit template instantiation may name private members; the friend function hands the
// pointer to member out.
template <class Tag, typename Tag::type Member>
struct Expose {
  friend typename Tag::type member(Tag) { return Member; }
};

using FixMap = std::map<std::string, FixCreator>;
using CommandMap = std::map<std::string, CommandCreator>;

struct ModifyFixMap {
  using type = FixMap* LAMMPS_NS::Modify::*;
  friend type member(ModifyFixMap);
};
template struct Expose<ModifyFixMap, &LAMMPS_NS::Modify::fix_map>;

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

struct FixMeshMesh {
  using type = LAMMPS_NS::AbstractMesh* LAMMPS_NS::FixMesh::*;
  friend type member(FixMeshMesh);
};
template struct Expose<FixMeshMesh, &LAMMPS_NS::FixMesh::mesh_>;

struct HistoryKeep {
  using type = bool** LAMMPS_NS::FixContactHistoryMesh::*;
  friend type member(HistoryKeep);
};
template struct Expose<HistoryKeep, &LAMMPS_NS::FixContactHistoryMesh::keepflag_>;

/// Number of the line that the stream has just been read up to; 0 when it cannot be told (standard
/// input).
long line_number(FILE* file) {
  const long position = file ? std::ftell(file) : -1;
  if (position < 0 || file == stdin) return 0;
  std::rewind(file);
  long lines = 0;
  int last = '\n';
  for (long i = 0; i < position; ++i) {
    last = std::fgetc(file);
    lines += last == '\n';
  }
  std::fseek(file, position, SEEK_SET);
  return lines + (last != '\n');
}

std::string file_name(FILE* file) {
  char path[4096];
  const ssize_t length =
      readlink(fmt::format("/proc/self/fd/{}", fileno(file)).c_str(), path, sizeof path - 1);
  return length > 0 ? std::string(path, static_cast<std::size_t>(length)) : "input script";
}

}  // namespace

void check_library(const LAMMPS_NS::LAMMPS& lammps) {
  const std::string version = lammps.universe->version;
  if (version.find("3.8.0") == std::string::npos)
    throw Error(
        "the LIGGGHTS library at hand is '" + version +
        "', but furrow uses the class layout of 3.8.0; install Debian 12's libliggghts3 3.8.0");
}

void add_fix_style(LAMMPS_NS::LAMMPS& lammps, const std::string& style, FixCreator creator) {
  (*(lammps.modify->*member(ModifyFixMap{})))[style] = creator;
}

void add_command(LAMMPS_NS::LAMMPS& lammps, const std::string& name, CommandCreator creator) {
  (*(lammps.input->*member(InputCommandMap{})))[name] = creator;
}

std::string script_position(const LAMMPS_NS::LAMMPS& lammps) {
  if (!lammps.input || !lammps.infile) return "";
  const char* text = lammps.input->*member(InputLine{});
  const long line = line_number(lammps.infile);
  if (line == 0) return text ? fmt::format("standard input: {}", text) : "";
  return fmt::format("{}, line {}: {}", file_name(lammps.infile), line, text ? text : "");
}

std::string script_name(const LAMMPS_NS::LAMMPS& lammps) {
  return lammps.infile && lammps.infile != stdin ? file_name(lammps.infile) : "";
}

std::string script_folder(const LAMMPS_NS::LAMMPS& lammps) {
  int rank = 0;
  MPI_Comm_rank(lammps.world, &rank);
  std::string folder =
      rank == 0 ? std::filesystem::path(script_name(lammps)).parent_path().string() : "";
  int size = static_cast<int>(folder.size());
  MPI_Bcast(&size, 1, MPI_INT, 0, lammps.world);
  folder.resize(static_cast<std::size_t>(size));
  MPI_Bcast(folder.data(), size, MPI_CHAR, 0, lammps.world);
  return folder;
}

void replace_mesh(LAMMPS_NS::FixMesh& fix, LAMMPS_NS::AbstractMesh* mesh) {
  LAMMPS_NS::AbstractMesh*& slot = fix.*member(FixMeshMesh{});
  delete slot;
  slot = mesh;
}

bool contact_seen(LAMMPS_NS::FixContactHistoryMesh& history, int grain, int slot) {
  return (history.*member(HistoryKeep{}))[grain][slot];
}

}  // namespace furrow::coupling
