// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix furrow/expected_states: made by read_restart for a checkpoint with states of Furrow's fixes.
/// LIGGGHTS forgets, without a word, what no line has claimed when the first run begins.

#include "coupling/liggghts/styles/style_registry.h"
#include "fix.h"

namespace furrow::coupling {

class FixExpectedStates : public LAMMPS_NS::Fix {
 public:
  FixExpectedStates(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema() { return Schema("fix furrow/expected_states"); }
  static OutputTable outputs() { return {}; }
  /// Adds the fix if the checkpoint that was just read has such states.
  static void add_if_needed(LAMMPS_NS::LAMMPS& lammps);

  int setmask() override { return 0; }
  void init() override;
};

}  // namespace furrow::coupling
