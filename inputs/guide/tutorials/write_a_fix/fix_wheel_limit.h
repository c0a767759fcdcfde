// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix wheel/limit: ends a run when a wheel is too deep. See fix_wheel_limit.md.

#include "coupling/base/fix_wheel_hub.h"

namespace furrow::coupling {

class FixWheelLimit : public FurrowFix {
 public:
  FixWheelLimit(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();
  static const Outputs<FixWheelLimit>& outputs();

  int setmask() override;
  void end_of_step() override;

 private:
  FixWheelHub& wheel_;
  double ground_level_, limit_;  // [m]
  double largest_ = 0.0;         // hub drop so far [m]
};

}  // namespace furrow::coupling
