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
class Dependent {
 public:
  virtual ~Dependent() = default;
  virtual bool needs(LAMMPS_NS::Fix& other) const = 0;
};

/// For pre_delete(true), that is for unfix and for a second fix of the same id. @throws StateError
/// when another fix needs this one
inline void refuse_if_needed(LAMMPS_NS::Modify& modify, LAMMPS_NS::Fix& fix) {
  for (int i = 0; i < modify.nfix; ++i) {
    const auto* dependent = dynamic_cast<const Dependent*>(modify.fix[i]);
    if (dependent && dependent->needs(fix))
      throw StateError(fmt::format(
          "fix {}: cannot be removed or replaced while fix {} uses it; write 'unfix {}' before",
          fix.id, modify.fix[i]->id, modify.fix[i]->id));
  }
}

}  // namespace furrow::coupling
