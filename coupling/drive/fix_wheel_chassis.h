// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix wheel/chassis: one rigid body on the suspensions of several rigs. See fix_wheel_chassis.md.

#include <vector>

#include "coupling/base/roles/motion_controller.h"
#include "coupling/drive/fix_wheel_rig.h"
#include "furrow/rig/chassis.h"

namespace furrow::coupling {

class FixWheelChassis : public FurrowFix, public MotionController {
 public:
  FixWheelChassis(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema() { return Chassis::schema("fix wheel/chassis"); }
  static const Outputs<const Chassis>& outputs() { return Chassis::outputs(); }

  bool uses(const LAMMPS_NS::Fix& other) const override;
  void pre_delete(bool unfixing) override;
  void apply(double time, double dt) override { chassis_.apply(time, dt); }

 private:
  std::vector<FixWheelRig*> find_rigs() const;
  void check_equal_motion() const;
  Chassis make_chassis() const;
  void checkpoint(Checkpoint& state) override { chassis_.checkpoint(state); }

  std::vector<FixWheelRig*> rigs_;
  Chassis chassis_;
};

}  // namespace furrow::coupling
