// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// run_until_steady: goes on with the scene until the values of its wheels are steady. See
/// command_run_until_steady.md.

#include <string>
#include <vector>

#include "coupling/liggghts/styles/style_registry.h"
#include "pointers.h"

namespace furrow::coupling {

class FixWheelHistory;

class CommandRunUntilSteady : protected LAMMPS_NS::Pointers {
 public:
  explicit CommandRunUntilSteady(LAMMPS_NS::LAMMPS* lammps) : Pointers(lammps) {}
  static Schema schema();
  static OutputTable outputs() { return {}; }

  void command(int narg, char** arg);

 private:
  /// Names the quantities that are not steady yet; empty when all are. Collective.
  std::string unsteady(const std::vector<FixWheelHistory*>& histories, double target) const;
  /// Time until the first of the wheels reaches the end of the ground [s]; infinite without one.
  double time_left(const std::vector<FixWheelHistory*>& histories) const;
  void run(long steps);
};

}  // namespace furrow::coupling
