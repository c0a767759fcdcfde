// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Errors of lines that follow in the script, before a command that takes hours.

#include "lammps.h"

namespace furrow::coupling {

/// Looks at the fix lines after the present one in the same file: style, keywords and values
/// without a variable. A script that jumps is left alone. Collective. @throws InputError naming the
/// line
void check_later_lines(const LAMMPS_NS::LAMMPS& lammps);

}  // namespace furrow::coupling
