// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/bodies/fix_plate_rigid.h"

#include "coupling/base/args.h"

namespace furrow::coupling {

Schema FixPlateRigid::schema() {
  Schema schema = RigidPlate::schema("fix plate/rigid");
  schema.number("speed", "m/s", Range::non_negative(), "downward speed");
  schema.number("start", "s", Range::non_negative(), "time at which the plate sets off")
      .by_default(0.0);
  schema.number("accelerate_time", "s", Range::non_negative(),
                "time in which it gains its speed, smoothly");
  schema.number("ground_level", "m", Range::any(),
                "z of the undisturbed ground: datum of the sinkage");
  return schema;
}

FixPlateRigid::FixPlateRigid(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixPlateRigid(lammps, narg, arg, schema().read(args_after_style(narg, arg))) {}

FixPlateRigid::FixPlateRigid(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg,
                             const Options& options)
    : FixBody(lammps, narg, arg, std::make_unique<RigidPlate>(options)),
      options_(options),
      ramp_{options.number("start"), options.number("accelerate_time")},
      speed_(options.number("speed")),
      ground_level_(options.number("ground_level")) {
  vector_flag = 1;
  size_vector = 3;
  global_freq = 1;
  extvector = 0;
}

void FixPlateRigid::post_create() {
  FixBody::post_create();
  FixCoupledSystem::of(*lmp).add(static_cast<MotionController&>(*this));
}

void FixPlateRigid::pre_delete(bool unfixflag) {
  if (unfixflag) FixCoupledSystem::of(*lmp).remove(static_cast<MotionController&>(*this));
  FixBody::pre_delete(unfixflag);
}

void FixPlateRigid::apply(double time, double dt) {
  plate().prescribe(-speed_ * ramp_.mean(time, time + dt));
}

double FixPlateRigid::compute_vector(int n) {
  switch (n) {
    case 0:
      return ground_level_ - plate().centre().z();
    case 1:
      return plate().surface().total_force().z();
    default:
      return plate().mean_pressure();
  }
}

}  // namespace furrow::coupling
