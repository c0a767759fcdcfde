// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The last line `bed` of a script. The command keeps it in variables of the script; results files
/// and checkpoints read it from there.

#include <string>
#include <utility>
#include <vector>

#include "lammps.h"

namespace furrow::coupling {

/// Keywords and values of the line: "script" and its path first, then the others.
using BedLine = std::vector<std::pair<std::string, std::string>>;

/// @param values of all parameters, equal for equal beds
void set_bed_line(LAMMPS_NS::LAMMPS& lammps, const BedLine& line, const std::string& values);
/// Names and values of the line `bed`; empty without one.
BedLine bed_line(LAMMPS_NS::LAMMPS& lammps);
/// Values of the bed, on which alone a run is continued; "none" without one.
std::string bed_values(LAMMPS_NS::LAMMPS& lammps);

}  // namespace furrow::coupling
