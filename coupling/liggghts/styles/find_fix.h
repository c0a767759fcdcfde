// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The fix that a keyword names.

#include <string>
#include <vector>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/core/options/options.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/liggghts/styles/configured_style.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "lammps.h"

namespace furrow::coupling {

/// @param key of the options: its value is the id of the fix
/// @param kinds of the styles whose class Wanted is, for the error
/// @throws InputError when there is no fix of that id, or one of another class
template <class Wanted>
Wanted& find_fix(LAMMPS_NS::LAMMPS& lammps, const Options& options, const std::string& key,
                 const std::vector<std::string>& kinds) {
  const std::string& id = options.text(key);
  LAMMPS_NS::Modify& modify = *lammps.modify;
  LAMMPS_NS::Fix* fix = modify.find_fix_id(id.c_str());
  if (auto* wanted = dynamic_cast<Wanted*>(fix)) return *wanted;

  std::string ids;
  for (Wanted* each : fixes_of<Wanted>(modify))
    ids += (ids.empty() ? "" : ", ") + std::string(as_fix(*each).id);
  throw InputError(options.where(key),
                   fix ? fmt::format("is '{}', which is a fix {}", id, style_of(*fix))
                       : fmt::format("is '{}', and no fix has that id", id),
                   fmt::format("the id of a fix {}, here {}", style_names(kinds),
                               ids.empty() ? "none yet" : "one of: " + ids),
                   "write that fix before this line");
}

}  // namespace furrow::coupling
