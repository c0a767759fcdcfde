// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "coupling/bodies/fix_body.h"

namespace furrow::coupling {

/// A body and the line that drives it: a wheel and its rig, or a plate.
struct DrivenBody {
  const FixBody& body;
  const Options& options;  ///< with the keys "ground_level", "speed" and "start"
};

std::vector<DrivenBody> driven_bodies(const LAMMPS_NS::Modify& modify);

}  // namespace furrow::coupling
