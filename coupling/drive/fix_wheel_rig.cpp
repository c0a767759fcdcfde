// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/drive/fix_wheel_rig.h"

#include <fmt/format.h>

#include "core/error.h"
#include "coupling/base/uses_fix.h"
#include "coupling/bodies/fix_wheel_hub.h"
#include "coupling/liggghts/errors.h"
#include "coupling/base/args.h"
#include "modify.h"

namespace furrow::coupling {

namespace {

/// The wheel of that fix id, if no other rig has it.
FixWheelHub& find_free_wheel(LAMMPS_NS::LAMMPS& lammps, const Options& options) {
  const std::string where = options.where("wheel"), &id = options.text("wheel");
  auto* wheel = dynamic_cast<FixWheelHub*>(&FixCoupledSystem::find_body(lammps, where, id));
  if (!wheel)
    throw InputError(where, fmt::format("is '{}', which is a body but no wheel", id),
                     "the id of a fix wheel/rigid or tyre/darnell");
  for (int i = 0; i < lammps.modify->nfix; ++i) {
    auto* other = dynamic_cast<FixWheelRig*>(lammps.modify->fix[i]);
    if (other && &other->wheel_fix() == wheel)
      throw InputError(where, fmt::format("is '{}', which fix {} drives already", id, other->id),
                       "one rig a wheel",
                       fmt::format("remove one of them, or write 'unfix {}' before", other->id));
  }
  return *wheel;
}

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
  schema.text("wheel", "id of the fix wheel/rigid or tyre/darnell that it drives");
  return schema;
}

FixWheelRig::FixWheelRig(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg),
      options_(schema().read(args_after_style(narg, arg))),
      wheel_fix_(find_free_wheel(*lammps, options_)),
      rig_(make_rig(options_, wheel_fix_)) {}

bool FixWheelRig::uses(LAMMPS_NS::Fix& other) const { return &other == &wheel_fix_; }

void FixWheelRig::post_create() {
  FixCoupledSystem::of(*lmp).add(static_cast<MotionController&>(*this));
}

void FixWheelRig::pre_delete(bool unfixflag) {
  if (!unfixflag) return;
  with_collective_errors(*error, [&] { forbid_removal_while_used(*modify, *this); });
  FixCoupledSystem::of(*lmp).remove(static_cast<MotionController&>(*this));
}

}  // namespace furrow::coupling
