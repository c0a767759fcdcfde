// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix plate/rigid: a rigid plate, annulus or cone that is pushed into the ground and turned. See
/// fix_plate_rigid.md.

#include "furrow/bodies/rigid_plate.h"
#include "coupling/base/fix_body.h"
#include "furrow/rig/ramp.h"

namespace furrow::coupling {

class FixPlateRigid : public FixBody, public MotionController {
 public:
  FixPlateRigid(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();
  static const Outputs<FixPlateRigid>& outputs();

  void apply(double time, double dt) override;
  double full_speed() const { return ramp_.end(); }  ///< time from which it has its speed [s]
  bool turns() const { return spin_ != 0.0; }
  const Vector3& direction() const { return direction_; }  ///< of the motion, of unit length

 protected:
  // Constructor and helpers of plates with other shapes.
  using Direction = std::function<Vector3(const Options&)>;
  /// @param direction of the motion, of unit length
  FixPlateRigid(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, const Schema& schema,
                const MakeBody& make_plate, const Direction& direction);
  static void declare_motion(Schema& schema, const std::string& speed);

  RigidPlate& plate() { return static_cast<RigidPlate&>(body()); }
  Vector3 force() { return plate().surface().total_force(); }
  double sinkage() { return ground_level_ - plate().surface().bounds().first.z(); }

 private:
  Ramp ramp_, spin_ramp_;
  double speed_;  // [m/s]
  Vector3 direction_;
  double load_;          // [N] infinity: the speed does not depend on the force
  double spin_;          // [rad/s] about z
  double ground_level_;  // [m]
};

}  // namespace furrow::coupling
