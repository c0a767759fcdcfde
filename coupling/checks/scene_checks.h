// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What only the scene as a whole shows: a wheel that touches nothing, cells too wide for it,
/// grains that nothing moves. furrow/system looks before every run; what one line shows, its fix
/// refuses itself.

#include <array>
#include <functional>
#include <set>
#include <string>

#include "lammps.h"

namespace furrow::coupling {

/// Edges of the simulation box [m].
using Box = std::array<double, 6>;

/// Says what may be meant but probably is not.
using Warn = std::function<void(const std::string&)>;

class SceneChecks {
 public:
  explicit SceneChecks(LAMMPS_NS::LAMMPS& lammps);

  /// All checks; a warning comes once, however many runs there are. Collective.
  /// @throws StateError, InputError
  void before_run();
  /// Collective.
  void after_run();
  /// A body may come to need shorter steps while it is deformed. Collective.
  void after_step(int sub_steps);
  /// What may be behind an error of this run, as an end of its message; may be empty.
  std::string likely_cause() const;

 private:
  void say(const std::string& warning);

  LAMMPS_NS::LAMMPS& lammps_;
  std::set<std::string> said_;
  std::string slow_step_;    // why steps are slow; empty unless that was said
  bool first_step_ = false;  // of the run, comes next
  double grains_ = 0;        // at the start of the run
  Box box_;                  // when the first body was made
};

}  // namespace furrow::coupling
