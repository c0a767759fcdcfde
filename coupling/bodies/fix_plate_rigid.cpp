// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/bodies/fix_plate_rigid.h"

#include "coupling/liggghts/style_registry.h"

namespace furrow::coupling {

const StyleRow plate_rigid_style =
    fix_style<FixPlateRigid>("plate/rigid", "body", "bodies/fix_plate_rigid.md");

Schema FixPlateRigid::schema() {
  Schema schema = RigidPlate::schema("fix plate/rigid");
  schema.number("speed", "m/s", Range::closed(0.0, 1000.0), "downward speed");
  schema.number("start", "s", Range::non_negative(), "time at which the plate starts to move")
      .by_default(0.0);
  schema.number("accelerate_time", "s", Range::non_negative(),
                "time in which the plate reaches its speed, smoothly");
  schema.number("ground_level", "m", Range::any(),
                "z of the undisturbed ground, the datum of the sinkage");
  return schema;
}

const Outputs<FixPlateRigid>& FixPlateRigid::outputs() {
  using Fix = FixPlateRigid;
  static const Outputs<Fix> list = {
      {"sinkage", "m", "ground level minus the lower face of the plate",
       [](Fix& fix) { return fix.ground_level_ - fix.plate().centre().z(); }},
      {"force", "N", "upward force of the ground on the plate",
       [](Fix& fix) { return fix.plate().surface().total_force().z(); }},
      {"pressure", "Pa", "force over the area of the plate",
       [](Fix& fix) { return fix.plate().mean_pressure(); }},
  };
  return list;
}

FixPlateRigid::FixPlateRigid(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixBody(lammps, narg, arg, schema(),
              [](const Options& options) { return std::make_unique<RigidPlate>(options); }),
      ramp_{options().number("start"), options().number("accelerate_time")},
      speed_(options().number("speed")),
      ground_level_(options().number("ground_level")) {
  contribute(static_cast<MotionController&>(*this));
  provide(outputs());
}

void FixPlateRigid::apply(double time, double dt) {
  plate().prescribe(-speed_ * ramp_.mean(time, time + dt));
}

}  // namespace furrow::coupling
