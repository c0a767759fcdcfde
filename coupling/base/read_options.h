// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Options from the words of a line.

#include <algorithm>
#include <string>
#include <vector>

#include "furrow/core/options/options.h"
#include "coupling/liggghts/styles/script.h"

namespace furrow::coupling {

/// The words of a fix line after "fix id group style".
inline std::vector<std::string> args_after_style(int narg, char** arg) {
  return {arg + std::min(narg, 3), arg + narg};
}

/// The options of a fix line. Former names of keywords and unusual values cause a warning with the
/// line of the script. @throws InputError
inline Options read_options(LAMMPS_NS::LAMMPS& lammps, const Schema& schema, int narg, char** arg) {
  Options options = schema.read(args_after_style(narg, arg));
  const std::string position = script_position(lammps);
  for (const std::string& warning : options.warnings())
    warn(lammps, position.empty() ? warning : warning + "\n  at " + position);
  return options;
}

}  // namespace furrow::coupling
