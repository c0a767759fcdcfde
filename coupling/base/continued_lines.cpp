// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/base/continued_lines.h"

#include <map>
#include <set>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "furrow/core/error.h"
#include "coupling/base/roles/checkpointed_fix.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/liggghts/data/global_properties.h"
#include "coupling/liggghts/styles/configured_style.h"
#include "coupling/liggghts/styles/script.h"
#include "modify.h"

namespace furrow::coupling {

namespace {

std::string lines_of_restorable_fixes(const LAMMPS_NS::Modify& modify) {
  std::string names;
  for (const auto* fix : fixes_of<const CheckpointedFix>(modify))
    if (fix->must_be_restored()) names += name_of(as_fix(*fix)) + '\n';
  return names;
}

std::string lines_of_properties(const LAMMPS_NS::LAMMPS& lammps) {
  std::string text;
  for (const auto& [id, values] : global_properties(lammps)) text += id + ' ' + values + '\n';
  return text;
}

}  // namespace

void ContinuedLines::checkpoint(Checkpoint& state, const std::vector<std::string>& controllers) {
  std::string fixes = lines_of_restorable_fixes(*lammps_.modify);
  std::string properties = lines_of_properties(lammps_);
  std::string keywords = lines_of(controllers);
  state.value("fixes", fixes);
  state.value("properties", properties);
  state.value("controllers", keywords);
  if (state.saving()) return;
  fixes_ = fixes;
  properties_ = properties;
  controllers_ = keywords;
  unchecked_ = true;
}

void ContinuedLines::check(const std::vector<std::string>& controllers) {
  if (!std::exchange(unchecked_, false)) return;
  check_fixes();
  warn_of_properties();
  warn_of_controllers(controllers);
}

/// A state that the checkpoint has and the script lacks would be lost. A fix that the script has
/// and the checkpoint lacks begins as its line says.
void ContinuedLines::check_fixes() const {
  std::set<std::string> kept;
  std::istringstream lines(fixes_);
  for (std::string name; std::getline(lines, name);) kept.insert(name);
  for (const auto* fix : fixes_of<const CheckpointedFix>(*lammps_.modify)) {
    if (!fix->must_be_restored()) continue;
    const std::string name = name_of(as_fix(*fix));
    if (fix->restored())
      kept.erase(name);
    else
      warn(lammps_,
           fmt::format("{} has no state in the checkpoint: it starts as its line states", name));
  }
  if (!kept.empty())
    throw StateError(fmt::format(
        "the checkpoint has the state of {}, and the script that continues has no such line "
        "before its first run; write it there, with the same id and style",
        fmt::join(kept, ", ")));
}

/// Properties of grains may be changed on purpose between two stages of a run.
void ContinuedLines::warn_of_properties() const {
  const std::map<std::string, std::string> now = global_properties(lammps_);
  std::istringstream lines(properties_);
  for (std::string property, values; lines >> property && std::getline(lines >> std::ws, values);)
    if (const auto found = now.find(property); found != now.end() && found->second != values)
      warn(lammps_, fmt::format("fix property/global '{}' is {}, and was {} when the checkpoint "
                                "was written: the run continues with these other values",
                                property, found->second, values));
}

/// Keywords of controllers that keep no state, such as rigs: the others refuse other keywords
/// themselves.
std::string ContinuedLines::lines_of(const std::vector<std::string>& controllers) const {
  std::string lines;
  for (const std::string& id : controllers) {
    const auto* fix = dynamic_cast<const CheckpointedFix*>(lammps_.modify->find_fix_id(id.c_str()));
    if (!fix || fix->must_be_restored()) continue;
    for (const auto& [key, value] : fix->settings())
      lines += fmt::format("{}\t{}\t{}\n", name_of(as_fix(*fix)), key, value);
  }
  return lines;
}

/// A wheel may be driven in another way on purpose, in a second stage of a run.
void ContinuedLines::warn_of_controllers(const std::vector<std::string>& controllers) const {
  std::map<std::string, std::map<std::string, std::string>> now;
  std::istringstream present(lines_of(controllers)), saved(controllers_);
  std::string fix, key, value;
  const auto read = [&](std::istringstream& lines) -> bool {
    return std::getline(lines, fix, '\t') && std::getline(lines, key, '\t') &&
           std::getline(lines, value);
  };
  while (read(present)) now[fix][key] = value;
  std::set<std::string> missing;
  while (read(saved)) {
    if (!now.count(fix))
      missing.insert(fix);
    else if (now[fix][key] != value)
      warn(lammps_, fmt::format("{}, keyword '{}' is {}, and was {} when the checkpoint was "
                                "written: the run continues as this line states",
                                fix, key, now[fix][key], value));
  }
  if (!missing.empty())
    warn(lammps_, fmt::format("the run of the checkpoint had {}, and the script that continues has "
                              "no such line: the run continues without",
                              fmt::join(missing, ", ")));
}

}  // namespace furrow::coupling
