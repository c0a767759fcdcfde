// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The input as it took effect: every Furrow style with all its values, defaults included, then the
/// script itself.

#include <string>

#include "core/options.h"
#include "fix.h"

namespace furrow::coupling {

/// A style that can say what its options became.
class HasOptions {
 public:
  virtual ~HasOptions() = default;
  virtual const Options& options() const = 0;
};

/// "fix rig all wheel/rig wheel wheel speed 0.1 ..." for every described fix, and the text of the
/// main script.
std::string effective_input(LAMMPS_NS::LAMMPS& lammps);

}  // namespace furrow::coupling
