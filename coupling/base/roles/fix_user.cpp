// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/base/roles/fix_user.h"

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/liggghts/styles/configured_style.h"

namespace furrow::coupling {

const LAMMPS_NS::Fix* find_user(const LAMMPS_NS::Modify& modify, const std::string& style,
                                const LAMMPS_NS::Fix& used) {
  for (const auto* user : fixes_of<const FixUser>(modify))
    if (user->uses(used) && style_of(as_fix(*user)) == style) return &as_fix(*user);
  return nullptr;
}

void forbid_removal_while_used(const LAMMPS_NS::Modify& modify, const LAMMPS_NS::Fix& fix) {
  for (const auto* user : fixes_of<const FixUser>(modify))
    if (user->uses(fix)) {
      const char* id = as_fix(*user).id;
      throw StateError(fmt::format(
          "fix {}: cannot be removed or replaced while fix {} uses it; write 'unfix {}' before",
          fix.id, id, id));
    }
}

}  // namespace furrow::coupling
