// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The fixes of a scene by what they are: a class, or a role such as FixUser.

#include <type_traits>
#include <vector>

#include "fix.h"
#include "modify.h"

namespace furrow::coupling {

/// All fixes that are a Wanted, in the order of the script. While LIGGGHTS replaces a fix by
/// another of the same id, neither is among them.
template <class Wanted>
std::vector<Wanted*> fixes_of(const LAMMPS_NS::Modify& modify) {
  std::vector<Wanted*> found;
  for (int i = 0; i < modify.nfix; ++i)
    if (auto* wanted = dynamic_cast<Wanted*>(modify.fix[i])) found.push_back(wanted);
  return found;
}

/// The fix that plays a role.
template <class Role>
auto& as_fix(Role& role) {
  using FixOfRole = std::conditional_t<std::is_const_v<Role>, const LAMMPS_NS::Fix, LAMMPS_NS::Fix>;
  return dynamic_cast<FixOfRole&>(role);
}

}  // namespace furrow::coupling
