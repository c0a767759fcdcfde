#pragma once
/// fix wheel/rigid: a rigid wheel as a body. See fix_wheel_rigid.md.

#include "body/rigid_wheel.h"
#include "coupling/effective_input.h"
#include "coupling/fix_body.h"

namespace furrow::coupling {

class FixWheelRigid : public FixBody, public Described {
 public:
  FixWheelRigid(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema() { return RigidWheel::schema("fix wheel/rigid"); }

  RigidWheel& wheel() { return static_cast<RigidWheel&>(body()); }
  const Options& options() const override { return options_; }

 private:
  FixWheelRigid(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, const Options& options);
  Options options_;
};

}  // namespace furrow::coupling
