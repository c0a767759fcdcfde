// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix wheel/rig: drives a wheel. See fix_wheel_rig.md.

#include "coupling/base/uses_fix.h"
#include "coupling/output/effective_input.h"
#include "coupling/bodies/fix_coupled_system.h"
#include "fix.h"
#include "rig/wheel_rig.h"

namespace furrow::coupling {

class FixWheelHub;

class FixWheelRig : public LAMMPS_NS::Fix,
                    public MotionController,
                    public HasOptions,
                    public UsesFix {
 public:
  FixWheelRig(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();

  void post_create() override;
  void pre_delete(bool unfixflag) override;
  int setmask() override { return 0; }
  bool uses(LAMMPS_NS::Fix& other) const override;
  void apply(double time, double dt) override { rig_.apply(time, dt); }

  const WheelRig& rig() const { return rig_; }
  FixWheelHub& wheel_fix() { return wheel_fix_; }
  const Options& options() const override { return options_; }

 private:
  Options options_;
  FixWheelHub& wheel_fix_;
  WheelRig rig_;
};

}  // namespace furrow::coupling
