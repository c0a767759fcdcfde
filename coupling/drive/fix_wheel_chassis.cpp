// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/drive/fix_wheel_chassis.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/liggghts/styles/style_registry.h"

namespace furrow::coupling {

const StyleRow wheel_chassis_style =
    fix_style<FixWheelChassis>("wheel/chassis", "chassis", "drive/fix_wheel_chassis.md");

FixWheelChassis::FixWheelChassis(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FurrowFix(lammps, narg, arg, schema()), rigs_(find_rigs()), chassis_(make_chassis()) {
  provide(outputs(), [this]() -> const Chassis& { return chassis_; });
  contribute(static_cast<MotionController&>(*this));
  keep_state();
}

/// Finds the rigs by the ids of the keyword, with commas between them.
std::vector<FixWheelRig*> FixWheelChassis::find_rigs() const {
  std::vector<FixWheelRig*> rigs;
  std::istringstream ids(options().text("rigs"));
  for (std::string id; std::getline(ids, id, ',');) {
    auto* rig = dynamic_cast<FixWheelRig*>(modify->find_fix_id(id.c_str()));
    if (!rig || std::find(rigs.begin(), rigs.end(), rig) != rigs.end())
      throw InputError(
          options().where("rigs"),
          fmt::format("has '{}'{}", id, rig ? " 2 times" : ", which is no fix wheel/rig"),
          "ids of fixes wheel/rig with commas, each once",
          "write 'rigs left,right', after the lines of these rigs");
    rigs.push_back(rig);
  }
  if (rigs.size() < 2)
    throw InputError(options().where("rigs"), fmt::format("has {} rigs", rigs.size()), "at least 2",
                     "a rig alone has its own sprung mass");
  return rigs;
}

Chassis FixWheelChassis::make_chassis() const {
  check_equal_motion();
  std::vector<WheelRig*> rigs;
  for (FixWheelRig* fix : rigs_) rigs.push_back(&fix->rig_of_chassis());
  return Chassis(options(), rigs);
}

/// The body keeps the wheels at their distances.
void FixWheelChassis::check_equal_motion() const {
  const FixWheelRig& first = *rigs_.front();
  for (const FixWheelRig* rig : rigs_) {
    const std::string name = fmt::format("has the rig '{}'", rig->id);
    if (rig->options().text("lateral") != "held")
      throw InputError(options().where("rigs"), name + " with lateral free",
                       "rigs with lateral held",
                       "the chassis does not hold its wheels at their distances along y");
    if (rig->options().text("travel") != first.options().text("travel"))
      throw InputError(
          options().where("rigs"),
          fmt::format("{} with travel {}, and '{}' with travel {}", name,
                      rig->options().text("travel"), first.id, first.options().text("travel")),
          "one travel for all wheels of a chassis");
    for (const char* key : {"speed", "start", "settle_time", "accelerate_time", "gravity"})
      if (rig->options().has(key) && rig->options().number(key) != first.options().number(key))
        throw InputError(
            options().where("rigs"),
            fmt::format("{} with {} {:g}, and '{}' with {:g}", name, key,
                        rig->options().number(key), first.id, first.options().number(key)),
            fmt::format("one {} for all wheels of a chassis", key));
  }
}

bool FixWheelChassis::uses(const LAMMPS_NS::Fix& other) const {
  return FurrowFix::uses(other) || std::find(rigs_.begin(), rigs_.end(), &other) != rigs_.end();
}

void FixWheelChassis::pre_delete(bool unfixing) {
  FurrowFix::pre_delete(unfixing);
  if (unfixing) chassis_.release();
}

}  // namespace furrow::coupling
