// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Variables and files of a script as its text has them, without running it.

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace furrow::coupling {

struct ScriptVariables {
  /// Names with values as written, which the command line can replace.
  std::vector<std::pair<std::string, std::string>> defaults;
  std::set<std::string> computed;   ///< variables that the script computes
  std::set<std::string> mentioned;  ///< ${name}, $n, v_name, "variable name" and "next name"
  std::set<std::string> in_paths;   ///< variables on which the paths of included files depend
  std::vector<std::string> files;   ///< the script and what it includes
  std::vector<std::string>
      not_found;  ///< included files that could not be read, or whose path is computed

  bool has_default(const std::string& name) const;
};

/// Reads the script and the files that its lines include, jump to or make a bed of; whether a line
/// would be executed is not asked. A bed's path is relative to the file with its line.
/// @param values of variables given on the command line, for paths
ScriptVariables find_variables(const std::string& script,
                               std::map<std::string, std::string> values);

/// Variables and files of a script as one object of JSON, for other programs.
std::string variables_json(const ScriptVariables& variables);

}  // namespace furrow::coupling
