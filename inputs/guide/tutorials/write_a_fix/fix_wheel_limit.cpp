// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/output/fix_wheel_limit.h"

#include <algorithm>

#include <fmt/format.h>

#include "coupling/liggghts/styles/style_registry.h"

namespace furrow::coupling {

const StyleRow wheel_limit_style =
    fix_style<FixWheelLimit>("wheel/limit", "limit", "output/fix_wheel_limit.md");

Schema FixWheelLimit::schema() {
  Schema schema("fix wheel/limit");
  schema.text("wheel", "id of the fix of the wheel or tyre");
  schema.number("ground_level", "m", Range::any(), "z of the undisturbed ground");
  schema.number("hub_drop", "m", Range::positive(), "largest hub drop");
  return schema;
}

const Outputs<FixWheelLimit>& FixWheelLimit::outputs() {
  static const Outputs<FixWheelLimit> list = {
      {"largest", "m", "largest hub drop so far", [](FixWheelLimit& fix) { return fix.largest_; }}};
  return list;
}

FixWheelLimit::FixWheelLimit(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FurrowFix(lammps, narg, arg, schema()),
      wheel_(use<FixWheelHub>("wheel", {"wheel"})),
      ground_level_(options().number("ground_level")),
      limit_(options().number("hub_drop")) {
  nevery = 10;
  provide(outputs());
}

int FixWheelLimit::setmask() { return LAMMPS_NS::FixConst::END_OF_STEP; }

void FixWheelLimit::end_of_step() {
  const double drop = ground_level_ - wheel_.hub().lowest_point();
  largest_ = std::max(largest_, drop);
  collectively([&] {
    if (drop > limit_)
      throw StateError(
          fmt::format("{}: the hub of '{}' has dropped by {:.3g} m, more than {:g} m. "
                      "Lower the load, or raise 'hub_drop'.",
                      name(), wheel_.id, drop, limit_));
  });
}

}  // namespace furrow::coupling
