// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Is the LIGGGHTS library at hand the one this executable was built for?

#include <string>

#include "lammps.h"

namespace furrow::coupling {

/// The only version whose class layouts and symbols the files of this folder know.
inline constexpr char liggghts_version[] = "3.8.0";

/// LAMMPS::create() as the linker knows it: overrides.cpp stands in front of it and calls it.
inline constexpr char create_symbol[] = "_ZN9LAMMPS_NS6LAMMPS6createEv";

/// The start-up self-test: version, symbols, and members that are reached by layout.
/// @throws Error that names what differs and the version that is needed
void check_library(const LAMMPS_NS::LAMMPS& lammps);

/// Address of the next definition of a symbol behind this executable's own; null when there is
/// none.
void* next_definition(const char* symbol);

}  // namespace furrow::coupling
