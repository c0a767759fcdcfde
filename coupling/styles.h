// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The table of Furrow's fix styles and commands.

#include "lammps.h"

namespace furrow::coupling {

/// Makes them known to LIGGGHTS. @throws nothing: a library of another version is a LIGGGHTS error
void add_styles(LAMMPS_NS::LAMMPS& lammps);

}  // namespace furrow::coupling
