// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/base/uses_fix.h"

#include <fmt/format.h>

#include "core/error.h"

namespace furrow::coupling {

void forbid_removal_while_used(const LAMMPS_NS::Modify& modify, const LAMMPS_NS::Fix& fix) {
  for (int i = 0; i < modify.nfix; ++i) {
    const auto* user = dynamic_cast<const UsesFix*>(modify.fix[i]);
    if (user && user->uses(fix))
      throw StateError(fmt::format(
          "fix {}: cannot be removed or replaced while fix {} uses it; write 'unfix {}' before",
          fix.id, modify.fix[i]->id, modify.fix[i]->id));
  }
}

}  // namespace furrow::coupling
