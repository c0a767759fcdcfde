// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/wheels/fix_plate_rigid.h"

#include <algorithm>
#include <limits>

#include "coupling/liggghts/styles/style_registry.h"

namespace furrow::coupling {

const StyleRow plate_rigid_style =
    fix_style<FixPlateRigid>("plate/rigid", "body", "wheels/fix_plate_rigid.md");

Schema FixPlateRigid::schema() {
  Schema schema = RigidPlate::schema("fix plate/rigid");
  declare_motion(schema, "downward speed");
  return schema;
}

void FixPlateRigid::declare_motion(Schema& schema, const std::string& speed) {
  schema.number("speed", "m/s", Range::closed(0.0, 1000.0), speed);
  schema.number("start", "s", Range::non_negative(), "time at which the plate starts to move")
      .by_default(0.0);
  schema.number("accelerate_time", "s", Range::non_negative(),
                "time in which the plate reaches its speed, smoothly");
  schema.number("load", "N", Range::positive(), "force that the drive holds; by default the speed")
      .optional();
  schema.number("spin", "rad/s", Range::closed(-100.0, 100.0), "rate of turning about the axis")
      .by_default(0.0);
  schema.number("spin_start", "s", Range::non_negative(), "time at which the plate starts to turn")
      .by_default(0.0);
  schema.number("ground_level", "m", Range::any(),
                "z of the undisturbed ground, the datum of the sinkage");
}

const Outputs<FixPlateRigid>& FixPlateRigid::outputs() {
  using Fix = FixPlateRigid;
  static const Outputs<Fix> list = {
      {"sinkage", "m", "ground level minus the lower face of the plate",
       [](Fix& fix) { return fix.sinkage(); }},
      {"force", "N", "upward force of the ground on the plate",
       [](Fix& fix) { return fix.force().z(); }},
      {"pressure", "Pa", "force over the area of the plate",
       [](Fix& fix) { return fix.plate().mean_pressure(); }},
      {"torque", "N m", "moment of the ground on the plate about its axis",
       [](Fix& fix) { return fix.plate().torque(); }},
      {"turned", "rad", "angle about the axis since the start",
       [](Fix& fix) { return fix.plate().turned(); }},
  };
  return list;
}

FixPlateRigid::FixPlateRigid(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixPlateRigid(
          lammps, narg, arg, schema(),
          [](const Options& options) { return std::make_unique<RigidPlate>(options); },
          [](const Options&) { return Vector3(0.0, 0.0, -1.0); }) {
  provide(outputs());
}

FixPlateRigid::FixPlateRigid(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, const Schema& schema,
                             const MakeBody& make_plate, const Direction& direction)
    : FixBody(lammps, narg, arg, schema, make_plate),
      ramp_{options().number("start"), options().number("accelerate_time")},
      spin_ramp_{options().number("spin_start"), options().number("accelerate_time")},
      speed_(options().number("speed")),
      direction_(direction(options())),
      load_(options().has("load") ? options().number("load")
                                  : std::numeric_limits<double>::infinity()),
      spin_(options().number("spin")),
      ground_level_(options().number("ground_level")) {
  contribute(static_cast<MotionController&>(*this));
}

void FixPlateRigid::apply(double time, double dt) {
  const double missing = std::max(1.0 + force().dot(direction_) / load_, -1.0);
  plate().prescribe(speed_ * missing * ramp_.mean(time, time + dt) * direction_,
                    spin_ * spin_ramp_.mean(time, time + dt));
}

}  // namespace furrow::coupling
