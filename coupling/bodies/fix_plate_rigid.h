// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix plate/rigid: a rigid plate, annulus or cone that is pushed into the ground and turned. See
/// fix_plate_rigid.md.

#include "bodies/rigid_plate.h"
#include "coupling/base/fix_body.h"
#include "rig/ramp.h"

namespace furrow::coupling {

class FixPlateRigid : public FixBody, public MotionController {
 public:
  FixPlateRigid(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();
  static const Outputs<FixPlateRigid>& outputs();

  void apply(double time, double dt) override;
  double full_speed() const { return ramp_.end(); }  ///< time from which it has its speed [s]
  bool turns() const { return spin_ != 0.0; }

 private:
  RigidPlate& plate() { return static_cast<RigidPlate&>(body()); }

  Ramp ramp_, spin_ramp_;
  double speed_;         // [m/s] downwards
  double load_;          // [N] infinity: the speed does not depend on the force
  double spin_;          // [rad/s] about z
  double ground_level_;  // [m]
};

}  // namespace furrow::coupling
