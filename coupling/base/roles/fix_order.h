// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Order of the fixes in a phase of a step. LIGGGHTS calls them in the order of its list, which is
/// the order of their lines; some of Furrow's fixes rely on it.

#include <string>

#include "fix.h"
#include "modify.h"

namespace furrow::coupling {

/// A fix whose turn must come after that of furrow/system, because it needs the bodies as the step
/// has moved them.
class SystemFollower {
 public:
  virtual ~SystemFollower() = default;
  /// The end of a sentence: "its triangles take the positions of the body's nodes".
  virtual std::string reason_to_follow() const = 0;
};

/// @throws StateError when a fix that follows the system stands before it
void check_fix_order(const LAMMPS_NS::Modify& modify, const LAMMPS_NS::Fix& system);

/// Checks a fix that must see all forces on grains.
/// @param reason  why: "forces that are added later would move the frozen slab"
/// @throws StateError when a fix that acts in post_force() stands after it
void check_last_of_forces(const LAMMPS_NS::Modify& modify, const LAMMPS_NS::Fix& fix,
                          const std::string& reason);

}  // namespace furrow::coupling
