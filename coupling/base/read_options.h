// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Options from the words of a line.

#include <algorithm>
#include <string>
#include <vector>

#include "core/options.h"
#include "coupling/liggghts/script.h"

namespace furrow::coupling {

/// The words of a fix line after "fix id group style".
inline std::vector<std::string> args_after_style(int narg, char** arg) {
  return {arg + std::min(narg, 3), arg + narg};
}

/// The options of a fix line; former names of keywords are reported. @throws InputError
inline Options read_options(LAMMPS_NS::LAMMPS& lammps, const Schema& schema, int narg, char** arg) {
  Options options = schema.read(args_after_style(narg, arg));
  for (const std::string& warning : options.warnings()) warn(lammps, warning);
  return options;
}

}  // namespace furrow::coupling
