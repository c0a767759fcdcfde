// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Turns the exceptions of src/ into LIGGGHTS errors: the only place where that happens.

#include <exception>

#include "error.h"

namespace furrow::coupling {

/// Runs an action that all ranks run alike.
template <class Action>
void with_collective_errors(LAMMPS_NS::Error& error, Action&& action) {
  try {
    action();
  } catch (const std::exception& exception) {
    error.all("furrow", 0, exception.what());
  }
}

/// Runs an action that may fail on this rank alone: the other ranks are aborted.
template <class Action>
void with_local_errors(LAMMPS_NS::Error& error, Action&& action) {
  try {
    action();
  } catch (const std::exception& exception) {
    error.one("furrow", 0, exception.what());
  }
}

}  // namespace furrow::coupling
