// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The input script: its present place, and lines that Furrow adds.

#include <optional>
#include <string>
#include <vector>

#include "lammps.h"
#include "fix.h"

namespace furrow::coupling {

/// Place of the command being executed, "in.wheel, line 12: fix wheel all ..."; empty outside a
/// script. Rank 0 only.
std::string script_position(const LAMMPS_NS::LAMMPS& lammps);
/// Path of the script being read; empty for standard input. Rank 0 only.
std::string script_name(const LAMMPS_NS::LAMMPS& lammps);
/// Folder of that script, from which files named in a script are found; empty for the current
/// folder. Collective.
std::string script_folder(const LAMMPS_NS::LAMMPS& lammps);

struct ScriptLine {
  long number;  ///< number of its first line in the file
  std::string text;
};
/// Lines after the present one in its file, continued lines joined. Empty for standard input. Rank
/// 0 only.
std::vector<ScriptLine> later_lines(const LAMMPS_NS::LAMMPS& lammps);

/// Reason why a file is no text that LIGGGHTS reads line by line; empty for one that is, or cannot
/// be read.
std::string script_text_problem(const std::string& path);

/// Checks a file before the command include reads it. @throws InputError for a file that is no
/// text, and for files that include themselves. Collective.
void check_include(const LAMMPS_NS::LAMMPS& lammps);

/// Adds a fix as the line "fix <words>" does. Not for the constructor of another fix: LIGGGHTS is
/// then in the middle of its list.
LAMMPS_NS::Fix& add_fix(LAMMPS_NS::LAMMPS& lammps, std::vector<std::string> words);
/// Adds a compute as the line "compute <words>" does, unless there is one of that id.
void add_compute(LAMMPS_NS::LAMMPS& lammps, std::vector<std::string> words);

/// Sets a variable as the line "variable <name> string <value>" does. @throws nothing: LIGGGHTS
/// ends the run when the variable is there and is no string
void set_variable(LAMMPS_NS::LAMMPS& lammps, std::string name, std::string value);
/// Value of a variable; nothing when there is none of that name.
std::optional<std::string> variable(LAMMPS_NS::LAMMPS& lammps, std::string name);

/// Prints a line to screen and log, on rank 0.
void announce(LAMMPS_NS::LAMMPS& lammps, const std::string& text);
/// Prints a text with "WARNING: " before it; the driver gets it too.
void warn(LAMMPS_NS::LAMMPS& lammps, const std::string& text);

}  // namespace furrow::coupling
