// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/drive/fix_wheel_rig.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/checksum.h"
#include "core/error.h"
#include "coupling/base/fix_coupled_system.h"
#include "coupling/liggghts/fixes_of.h"
#include "coupling/drive/tilted_gravity.h"
#include "coupling/liggghts/script.h"
#include "coupling/liggghts/style_registry.h"
#include "coupling/base/fix_terrain.h"
#include "io/csv_file.h"
#include "update.h"

namespace furrow::coupling {

namespace {

constexpr double min_steps_of_ramp = 10;

/// The columns of the table, each over the time. @throws InputError
Courses table_of(const Options& options) {
  Courses courses;
  if (!options.has("table")) return courses;
  const std::string& file = options.text("table");
  const CsvTable table = CsvTable::read(file);
  const std::vector<double> time = table.numbers("time");
  const std::vector<std::string>& known = WheelRig::changing_targets();
  for (const std::string& name : table.names()) {
    if (name == "time") continue;
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(options.where("table"), fmt::format("has the column '{}' in {}", name, file),
                       fmt::format("time [s] and {}", fmt::join(known, ", ")));
    const std::vector<double> values = table.numbers(name);
    std::vector<std::pair<double, double>> points;
    for (std::size_t i = 0; i < time.size(); ++i) points.emplace_back(time[i], values[i]);
    courses.emplace(name, Course(std::move(points)));
  }
  if (time.empty() || courses.empty())
    throw InputError(options.where("table"), fmt::format("is {}, which has no targets", file),
                     "a line of names, such as time,slip, and rows of numbers");
  return courses;
}

/// A rig is made with the wheel where the script puts it, also when the run continues: lowering,
/// heading and camber are told from there. A wheel that comes from a restart file then goes back to
/// the state it had.
WheelRig make_rig(const Options& options, FixWheelHub& wheel_fix, const Courses& table) {
  WheelHub& wheel = wheel_fix.hub();
  if (!wheel_fix.state_as_made()) return WheelRig(options, wheel, table);
  Checkpoint now("wheel");
  wheel.checkpoint(now);
  Checkpoint as_made = *wheel_fix.state_as_made();
  wheel.checkpoint(as_made);
  WheelRig rig(options, wheel, table);
  Checkpoint again = now.reread();
  wheel.checkpoint(again);
  wheel.set_vertical_damping(options.number("damping"));
  return rig;
}

}  // namespace

const StyleRow wheel_rig_style =
    fix_style<FixWheelRig>("wheel/rig", "rig", "drive/fix_wheel_rig.md");

Schema FixWheelRig::schema() {
  Schema schema = WheelRig::schema("fix wheel/rig");
  schema
      .text("table",
            "CSV file with the column `time` [s] and columns named as the targets, in the place "
            "of ramps")
      .optional();
  schema.text("wheel", "id of the fix of the wheel or tyre to drive; one rig per wheel");
  return schema;
}

FixWheelRig::FixWheelRig(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixRig(lammps, narg, arg, schema()),
      wheel_fix_(find_free_wheel()),
      table_(table_of(options())),
      rig_(make_rig(options(), wheel_fix_, table_)) {
  contribute(static_cast<MotionController&>(*this));
  if (rig_.has_suspension()) keep_state();
}

std::vector<std::pair<std::string, std::string>> FixWheelRig::settings() const {
  auto list = FurrowFix::settings();
  Checksum sum;
  for (const auto& [target, course] : table_) {
    sum.add(target.data(), target.size());
    for (const auto& [time, value] : course.points())
      for (const double number : {time, value}) sum.add(&number, sizeof number);
  }
  for (auto& [key, value] : list)
    if (key == "table" && !table_.empty())
      value += fmt::format(" with checksum {:016x}", sum.value());
  return list;
}

int FixWheelRig::setmask() { return on_slope() ? LAMMPS_NS::FixConst::POST_FORCE : 0; }

void FixWheelRig::init() {
  warn_of_short_ramps();
  collectively([&] {
    check_slope();
    check_passes();
  });
}

/// A rut is kept only by ground that stays where it is.
void FixWheelRig::check_passes() {
  if (rig_.passes() == 1) return;
  const auto refuse = [&](const LAMMPS_NS::Fix& ground) {
    throw InputError(
        options().where("passes"),
        fmt::format("is {} on ground that moves along and drops what is behind, fix {}",
                    rig_.passes(), ground.id),
        "fixed ground, longer than pass_length",
        "leave out 'follow' or the window, and make terrain or bed longer");
  };
  if (const auto* window = modify->find_fix_style("bed/window", 0)) refuse(*window);
  for (const auto* contact : fixes_of<UsesFix>(*modify))
    for (const auto* terrain : fixes_of<FixTerrain>(*modify))
      if (terrain->moves() && contact->uses(wheel_fix_) && contact->uses(*terrain))
        refuse(*terrain);
}

/// One ground has one slope. LIGGGHTS takes the gravity of clumps from fix gravity itself.
void FixWheelRig::check_slope() {
  for (const FixWheelRig* other : fixes_of<FixWheelRig>(*modify))
    for (const char* key : {"slope", "side_slope"})
      if (other->options().number(key) != options().number(key))
        throw InputError(
            options().where(key),
            fmt::format("is {:g} degrees, and that of fix {} is {:g}", options().number(key),
                        other->id, other->options().number(key)),
            "one slope for all rigs", "gravity is turned for the whole scene");
  if (on_slope() && modify->n_fixes_style("multisphere") > 0)
    throw InputError(options().where("slope"), "is given with a fix multisphere",
                     "a slope with single grains",
                     "turn the vector of fix gravity in the script, and leave out the slope");
}

void FixWheelRig::apply(double time, double dt) {
  rig_.apply(time, dt);
  if (on_slope()) tilt_gravity_of_terrain(*lmp, rig_.tilt(time + dt));
}

void FixWheelRig::change_targets(const std::vector<Entry>& targets) {
  const std::vector<std::string>& known = WheelRig::targets();
  for (const Entry& target : targets)
    if (std::find(known.begin(), known.end(), target.key) == known.end())
      throw InputError(options().where(target.key), "cannot change during a run",
                       fmt::format("{}", fmt::join(known, ", ")), "set it in the line of the rig");
  std::vector<Entry> entries;
  const auto is_new = [&](const std::string& key) {
    return std::any_of(targets.begin(), targets.end(),
                       [&](const Entry& target) { return target.key == key; });
  };
  for (const Entry& entry : options().effective())
    if (options().given(entry.key) && !is_new(entry.key)) entries.push_back(entry);
  entries.insert(entries.end(), targets.begin(), targets.end());
  const Options changed = schema().read(entries);
  rig_.retarget(changed);
  change_options(changed);
  last_change_ = FixCoupledSystem::of(*lmp).time();
}

void FixWheelRig::setup(int vflag) { post_force(vflag); }

void FixWheelRig::post_force(int) {
  // every rig has the same slope: the first turns the gravity of all grains
  if (on_slope() && fixes_of<FixWheelRig>(*modify).front() == this)
    tilt_gravity_of_grains(*lmp, rig_.tilt(FixCoupledSystem::of(*lmp).time()));
}

/// A ramp of a few steps is a blow.
void FixWheelRig::warn_of_short_ramps() {
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
  auto& wheel = use<FixWheelHub>("wheel", {"wheel"});
  for (FixWheelRig* other : fixes_of<FixWheelRig>(*modify))
    if (&other->wheel_fix() == &wheel)
      throw InputError(options().where("wheel"),
                       fmt::format("is '{}', which fix {} drives already", wheel.id, other->id),
                       "one rig for each wheel",
                       fmt::format("remove one of them, or write 'unfix {}' before", other->id));
  return wheel;
}

}  // namespace furrow::coupling
