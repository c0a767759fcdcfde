// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// In each phase of a step LIGGGHTS calls the fixes in the order of its list, which is that of
/// their lines. Some of Furrow's rely on it.

#include <string>

#include "fix.h"
#include "modify.h"

namespace furrow::coupling {

/// A fix whose turn must come after that of furrow/system, because it needs the bodies as the step
/// has moved them.
class FollowsSystem {
 public:
  virtual ~FollowsSystem() = default;
  /// The end of a sentence: "its triangles take the positions of the body's nodes".
  virtual std::string reason_to_follow() const = 0;
};

/// @throws StateError when a fix that follows the system stands before it
void check_fix_order(const LAMMPS_NS::Modify& modify, const LAMMPS_NS::Fix& system);

}  // namespace furrow::coupling
