// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Role of a fix that works with other fixes.

#include <string>

#include "fix.h"
#include "modify.h"

namespace furrow::coupling {

/// A fix that works with another one as long as it lives.
class FixUser {
 public:
  virtual ~FixUser() = default;
  virtual bool uses(const LAMMPS_NS::Fix& other) const = 0;
};

/// The first fix of a style that uses another one; null if there is none.
const LAMMPS_NS::Fix* find_user(const LAMMPS_NS::Modify& modify, const std::string& style,
                                const LAMMPS_NS::Fix& used);

/// Checks a removal in pre_delete(true), that is for unfix and for a second fix of the same id.
/// @throws StateError when another fix uses this one
void forbid_removal_while_used(const LAMMPS_NS::Modify& modify, const LAMMPS_NS::Fix& fix);

}  // namespace furrow::coupling
