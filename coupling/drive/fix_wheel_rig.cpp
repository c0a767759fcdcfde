// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/drive/fix_wheel_rig.h"

#include <fmt/format.h>

#include "core/error.h"
#include "coupling/bodies/fix_wheel_hub.h"
#include "coupling/liggghts/script.h"
#include "update.h"

namespace furrow::coupling {

namespace {

constexpr double min_steps_of_ramp = 10;

/// A rig is made with the wheel where the script puts it, also when the run continues: lowering,
/// heading and camber are told from there. A wheel that comes from a restart file then goes back to
/// the state it had.
WheelRig make_rig(const Options& options, FixWheelHub& wheel_fix) {
  WheelHub& wheel = wheel_fix.hub();
  if (!wheel_fix.state_as_made()) return WheelRig(options, wheel);
  Checkpoint now("wheel");
  wheel.checkpoint(now);
  Checkpoint as_made = *wheel_fix.state_as_made();
  wheel.checkpoint(as_made);
  WheelRig rig(options, wheel);
  Checkpoint again = now.reread();
  wheel.checkpoint(again);
  wheel.set_vertical_damping(options.number("damping"));
  return rig;
}

}  // namespace

Schema FixWheelRig::schema() {
  Schema schema = WheelRig::schema("fix wheel/rig");
  schema.text("wheel", "id of the fix of the wheel that it drives");
  return schema;
}

FixWheelRig::FixWheelRig(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FurrowFix(lammps, narg, arg, schema()),
      wheel_fix_(find_free_wheel()),
      rig_(make_rig(options(), wheel_fix_)) {
  contribute(static_cast<MotionController&>(*this));
}

/// A ramp of a few steps is a blow.
void FixWheelRig::init() {
  for (const char* key : {"settle_time", "load_ramp_time", "accelerate_time"})
    if (options().has(key) && options().number(key) < min_steps_of_ramp * update->dt && !warned_) {
      warned_ = true;
      warn(*lmp,
           fmt::format("{} is {:g} s, less than {:g} steps of {:g} s: the wheel is struck, "
                       "not moved; make it longer",
                       options().where(key), options().number(key), min_steps_of_ramp, update->dt));
    }
}

/// The wheel of the keyword, if no other rig has it.
FixWheelHub& FixWheelRig::find_free_wheel() {
  auto& wheel = use<FixWheelHub>("wheel", {Kind::wheel});
  for (FixWheelRig* other : fixes_of<FixWheelRig>(*modify))
    if (&other->wheel_fix() == &wheel)
      throw InputError(options().where("wheel"),
                       fmt::format("is '{}', which fix {} drives already", wheel.id, other->id),
                       "one rig for each wheel",
                       fmt::format("remove one of them, or write 'unfix {}' before", other->id));
  return wheel;
}

}  // namespace furrow::coupling
