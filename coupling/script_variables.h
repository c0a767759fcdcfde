// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What the text of a script says about variables, without running it.

#include <map>
#include <set>
#include <string>
#include <vector>

namespace furrow::coupling {

struct ScriptVariables {
  std::set<std::string> mentioned;         ///< ${name}, $n, v_name, "variable name" and "next name"
  std::vector<std::string> set_by_script;  ///< with a value that the command line can replace
  /// Every file that the script includes could be found; else nothing is known of what is missing.
  bool complete = true;
};

/// The script and the files that its lines include, jump to or make a bed of; whether a line would
/// be executed is not asked. @param values of variables given on the command line, for paths
ScriptVariables find_variables(const std::string& script,
                               std::map<std::string, std::string> values);

}  // namespace furrow::coupling
