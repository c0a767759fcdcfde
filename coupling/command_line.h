// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The command line of furrow: LIGGGHTS's, checked before LIGGGHTS reads it.

#include <string>
#include <vector>

namespace furrow::coupling {

struct CommandLine {
  struct Variable {
    std::string name;
    std::vector<std::string> values;
  };

  bool help = false, version = false, lists_variables = false, lists_keys = false;
  std::string script;  ///< empty: standard input
  std::vector<Variable> variables;
  std::vector<std::string> written_files;  ///< log and screen
};

/// @param words without the program's name. @throws InputError
CommandLine read_command_line(const std::vector<std::string>& words);

/// Looks for the files, and for variables that no line of the script reads. On one rank.
/// @throws InputError
void check_command_line(const CommandLine& line);

/// Arguments for the start of LIGGGHTS, without "-screen none": its mesh fixes write to the screen
/// and do not check that there is one. @param words the program's name and what follows
std::vector<std::string> words_for_liggghts(std::vector<std::string> words);

/// Variables and files of the script, as JSON. @throws InputError
std::string script_variables(const CommandLine& line);

std::string usage();

}  // namespace furrow::coupling
