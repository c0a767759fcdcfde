// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The input as it took effect: every Furrow style with all its values, defaults included.

#include <string>
#include <vector>

#include "furrow/io/results/style_record.h"
#include "lammps.h"

namespace furrow::coupling {

/// The bed, if there is one, then every fix that has options, in the order of the script.
std::vector<StyleRecord> style_records(LAMMPS_NS::LAMMPS& lammps);

/// Styles in effect as lines of a script, "fix rig all wheel/rig wheel wheel speed 0.1 ...", then
/// the text of the main script. Rank 0 only.
std::string effective_input(LAMMPS_NS::LAMMPS& lammps);

}  // namespace furrow::coupling
