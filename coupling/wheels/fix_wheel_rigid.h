// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix wheel/rigid: a rigid wheel as a body. See fix_wheel_rigid.md.

#include "furrow/bodies/rigid_wheel.h"
#include "coupling/base/fix_wheel_hub.h"

namespace furrow::coupling {

class FixWheelRigid : public FixWheelHub {
 public:
  FixWheelRigid(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema() { return RigidWheel::schema("fix wheel/rigid"); }

  RigidWheel& wheel() { return static_cast<RigidWheel&>(body()); }
};

}  // namespace furrow::coupling
