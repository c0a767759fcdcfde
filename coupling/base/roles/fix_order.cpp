// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/base/roles/fix_order.h"

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "coupling/liggghts/styles/configured_style.h"

namespace furrow::coupling {

void check_fix_order(const LAMMPS_NS::Modify& modify, const LAMMPS_NS::Fix& system) {
  for (int i = 0; i < modify.nfix && modify.fix[i] != &system; ++i) {
    const LAMMPS_NS::Fix& fix = *modify.fix[i];
    const auto* follower = dynamic_cast<const SystemFollower*>(&fix);
    if (follower)
      throw StateError(fmt::format(
          "fix {} '{}' comes before fix {} '{}' in a step, and must come after it: {}; write "
          "'unfix {}' and its line once more, behind the fix of the first body",
          style_of(fix), fix.id, system.style, system.id, follower->reason_to_follow(), fix.id));
  }
}

void check_last_of_forces(const LAMMPS_NS::Modify& modify, const LAMMPS_NS::Fix& fix,
                          const std::string& reason) {
  for (int i = modify.nfix - 1; i >= 0 && modify.fix[i] != &fix; --i)
    if (modify.fmask[i] & LAMMPS_NS::FixConst::POST_FORCE)
      throw StateError(
          fmt::format("{} comes after {} in a step, and must come before it: {}; write the line of "
                      "fix {} after all fixes that put forces on grains",
                      name_of(*modify.fix[i]), name_of(fix), reason, fix.id));
}

}  // namespace furrow::coupling
