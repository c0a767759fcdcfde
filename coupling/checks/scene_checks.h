// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What only the scene as a whole shows: a wheel that touches nothing, cells too wide for it,
/// grains that nothing moves. furrow/system looks before every run; what one line shows, its fix
/// refuses itself.

#include <functional>
#include <set>
#include <string>

#include "lammps.h"

namespace furrow::coupling {

/// Says what may be meant but probably is not.
using Warn = std::function<void(const std::string&)>;

class SceneChecks {
 public:
  explicit SceneChecks(LAMMPS_NS::LAMMPS& lammps) : lammps_(lammps) {}

  /// All checks; a warning comes once, however many runs there are. Collective.
  /// @throws StateError, InputError
  void before_run();
  /// Collective.
  void after_run();
  /// A body may come to need shorter steps while it is deformed. Collective.
  void after_step(int sub_steps);

 private:
  void say(const std::string& warning);

  LAMMPS_NS::LAMMPS& lammps_;
  std::set<std::string> said_;
  bool slow_ = false;  // that was said
  double grains_ = 0;  // at the start of the run
};

}  // namespace furrow::coupling
