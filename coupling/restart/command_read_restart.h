// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// read_restart: LIGGGHTS's own, for checkpoints that are whole. See command_read_restart.md.

#include "coupling/liggghts/styles/style_registry.h"
#include "pointers.h"

namespace furrow::coupling {

class CommandReadRestart : protected LAMMPS_NS::Pointers {
 public:
  explicit CommandReadRestart(LAMMPS_NS::LAMMPS* lammps) : Pointers(lammps) {}
  static Schema schema();
  static OutputTable outputs() { return {}; }

  void command(int narg, char** arg);
};

}  // namespace furrow::coupling
