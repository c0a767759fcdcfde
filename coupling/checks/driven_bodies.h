// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/bodies/fix_body.h"

namespace furrow::coupling {

/// A body and the line that drives it: a wheel and its rig, or a plate.
struct DrivenBody {
  const FixBody& body;
  const Options& options;  ///< with the keys "ground_level", "start" and, unless free, "speed"
  double full_speed;       ///< time from which it has its speed [s]
  std::string stages;      ///< the keys of the time until then
};

std::vector<DrivenBody> driven_bodies(const LAMMPS_NS::Modify& modify);

}  // namespace furrow::coupling
