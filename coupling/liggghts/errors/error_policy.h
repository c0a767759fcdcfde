// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// End of a run with an error: one message that names the line of the script, results saved, all
/// ranks stopped, a non-zero status. Error::all, one and fix_error of LIGGGHTS come here
/// (overrides.cpp).

#include <string>

#include "lammps.h"

namespace furrow::coupling {

/// An error that leaves the process alive, with the text that is printed. It is no std::exception,
/// which the fixes would turn into a second error on its way.
struct RunError {
  std::string text;
};

/// Makes errors throw RunError from now on, where they would end the process. An error of one rank
/// of several still aborts all of them.
void throw_errors();

/// Place in LIGGGHTS where an error was noticed; line 0: in Furrow.
struct SourcePlace {
  const char* file;
  int line;
};

/// Stops all ranks after an error that all have: they leave together, dumps and logs closed. An
/// error that should befall all may befall one (a particle of its part of the terrain): then as
/// stop_alone(), after five seconds. Collective.
[[noreturn]] void stop_together(LAMMPS_NS::LAMMPS& lammps, const std::string& text,
                                SourcePlace place);

/// Stops after an error of this rank alone: no message reaches the others, so the run is aborted.
/// Only rank 0 knows the number of the script's line; it saves results (rescue.h).
[[noreturn]] void stop_alone(LAMMPS_NS::LAMMPS& lammps, const std::string& text, SourcePlace place);

}  // namespace furrow::coupling
