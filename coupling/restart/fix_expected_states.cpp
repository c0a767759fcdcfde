// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/restart/fix_expected_states.h"

#include <algorithm>
#include <string>
#include <vector>

#include "furrow/core/error.h"
#include "coupling/base/fix_coupled_system.h"
#include "coupling/liggghts/data/access.h"
#include "coupling/liggghts/errors/errors.h"
#include "coupling/liggghts/styles/script.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "modify.h"

namespace furrow::coupling {

namespace {

constexpr char expected_id[] = "furrow_expected_states";

}  // namespace

const StyleRow expected_states_style =
    fix_style<FixExpectedStates>("furrow/expected_states", "internal", "");

FixExpectedStates::FixExpectedStates(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg) {
  if (id != std::string(expected_id))
    throw InputError("fix furrow/expected_states", "is written in the script", "no such line",
                     "remove it: read_restart makes it");
}

void FixExpectedStates::add_if_needed(LAMMPS_NS::LAMMPS& lammps) {
  const std::vector<std::string> styles = styles_in_restart_file(lammps);
  if (std::count(styles.begin(), styles.end(), "furrow/system"))
    add_fix(lammps, {expected_id, "all", "furrow/expected_states"});
}

/// Leaves the comparison of states with lines to furrow/system, if it exists in time.
void FixExpectedStates::init() {
  with_collective_errors(*error, [&] {
    const FixCoupledSystem* system = FixCoupledSystem::find(*lmp);
    if (!system || !system->restored())
      throw StateError(
          "the checkpoint has states of Furrow's fixes, and the script that continues has none of "
          "their lines before its first run; write them there, or read the grains alone with "
          "'read_restart <file> unchecked'");
  });
}

}  // namespace furrow::coupling
