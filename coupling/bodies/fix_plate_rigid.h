// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix plate/rigid: a rigid plate that is pushed into the bed. See fix_plate_rigid.md.

#include "bodies/rigid_plate.h"
#include "coupling/output/effective_input.h"
#include "coupling/bodies/fix_body.h"
#include "rig/ramp.h"

namespace furrow::coupling {

class FixPlateRigid : public FixBody, public MotionController, public HasOptions {
 public:
  FixPlateRigid(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();

  void post_create() override;
  void pre_delete(bool unfixflag) override;
  void apply(double time, double dt) override;
  /// f_id[1]: sinkage [m], f_id[2]: vertical force on the plate [N], f_id[3]: mean pressure [Pa]
  double compute_vector(int n) override;
  const Options& options() const override { return options_; }

 private:
  FixPlateRigid(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, const Options& options);
  RigidPlate& plate() { return static_cast<RigidPlate&>(body()); }

  Options options_;
  Ramp ramp_;
  double speed_;         // [m/s] downwards
  double ground_level_;  // [m]
};

}  // namespace furrow::coupling
