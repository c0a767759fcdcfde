// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Callbacks of a program that runs LIGGGHTS in its process, such as Python.

#include <string>

#include "lammps.h"

namespace furrow::coupling {

class Driver {
 public:
  virtual ~Driver() = default;
  /// Called before each step of a run, when the step before is complete with its output. LIGGGHTS
  /// has counted the step already.
  virtual void before_step(LAMMPS_NS::LAMMPS& lammps) = 0;
  /// Called before each command of a script. @return whether the command is left out
  virtual bool before_command(LAMMPS_NS::LAMMPS& lammps) = 0;
  /// A warning of Furrow, on the first rank.
  virtual void warned(const std::string& text) = 0;
};

/// The driver of the LIGGGHTS instance that runs now; null for the executable. Not owned.
Driver* driver();
void set_driver(Driver* driver);

}  // namespace furrow::coupling
