// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Fixes that hold on to other fixes.

#include <string>

#include <fmt/format.h>

#include "core/error.h"
#include "fix.h"
#include "modify.h"

namespace furrow::coupling {

/// A fix that works with another one as long as it lives.
class UsesFix {
 public:
  virtual ~UsesFix() = default;
  virtual bool uses(LAMMPS_NS::Fix& other) const = 0;
};

/// For pre_delete(true), that is for unfix and for a second fix of the same id. @throws StateError
/// when another fix needs this one
inline void forbid_removal_while_used(LAMMPS_NS::Modify& modify, LAMMPS_NS::Fix& fix) {
  for (int i = 0; i < modify.nfix; ++i) {
    const auto* user = dynamic_cast<const UsesFix*>(modify.fix[i]);
    if (user && user->uses(fix))
      throw StateError(fmt::format(
          "fix {}: cannot be removed or replaced while fix {} uses it; write 'unfix {}' before",
          fix.id, modify.fix[i]->id, modify.fix[i]->id));
  }
}

}  // namespace furrow::coupling
