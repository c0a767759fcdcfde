// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Checks the scene as a whole. furrow/system calls it; coupling/checks, which includes all other
/// folders, implements it.

#include <memory>
#include <string>

#include "lammps.h"

namespace furrow::coupling {

/// Checks of the scene before and during runs. All functions are collective. @throws InputError
class SceneWatch {
 public:
  virtual ~SceneWatch() = default;
  virtual void before_run() = 0;
  /// @param sub_steps of the bodies in this step
  virtual void after_step(int sub_steps) = 0;
  virtual void after_run() = 0;
  virtual void after_change_of_targets() = 0;
  /// The end of an error message of this run: its likely cause. May be empty.
  virtual std::string likely_cause() const = 0;
};

/// Makes the watch of a scene; defined in coupling/checks.
std::unique_ptr<SceneWatch> watch_scene(LAMMPS_NS::LAMMPS& lammps);

}  // namespace furrow::coupling
