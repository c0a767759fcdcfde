// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/drive/fix_wheel_rig.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "furrow/core/checksum.h"
#include "furrow/core/error.h"
#include "coupling/base/fix_coupled_system.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/drive/tilted_gravity.h"
#include "coupling/liggghts/styles/script.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "coupling/base/roles/ground.h"
#include "furrow/io/formats/csv_file.h"
#include "update.h"

namespace furrow::coupling {

namespace {

constexpr double min_steps_of_ramp = 10;
constexpr double minimum_damping_ratio = 0.01, minimum_torque = 1e-3;  // over load x radius
constexpr double never = -1.0;  // [s] time of a change that has not been

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

/// Makes a rig with the wheel where the script puts it, also when the run continues: lowering,
/// heading and camber start there. A wheel that comes from a restart file then goes back to the
/// state it had.
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
      rig_(make_rig(options(), wheel_fix_, table_)),
      line_(options()) {
  contribute(static_cast<MotionController&>(*this));
  keep_state();
}

/// Targets that a program has changed are part of the state, and not of the line. A line that has
/// another value of a target than that of the first run keeps it.
void FixWheelRig::checkpoint(Checkpoint& state) {
  std::map<std::string, std::string> line;
  for (const auto& [key, value] : settings_of(line_)) line[key] = value;
  std::string targets;
  for (const auto& [key, value] : changed_)
    targets += fmt::format("{}\t{}\t{}\n", key, value, line.at(key));
  state.value("changed_targets", targets);
  double last = last_change_.value_or(never);
  state.value("last_change", last);
  if (!state.saving()) {
    std::map<std::string, std::string> changed;
    std::istringstream rows(targets);
    const auto read = [&](std::string& word, char end) -> bool {
      return static_cast<bool>(std::getline(rows, word, end));
    };
    for (std::string key, value, was; read(key, '\t') && read(value, '\t') && read(was, '\n');)
      if (line.at(key) == was) changed[key] = value;
    if (!changed.empty()) retarget(changed);
    if (last != never) last_change_ = last;
  }
  rig_.checkpoint(state);
}

std::vector<std::pair<std::string, std::string>> FixWheelRig::settings() const {
  auto list = settings_of(line_);
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

/// Warns once, before a run, of a spring that gives by more than the radius.
void FixWheelRig::warn_of_soft_spring() {
  if (!rig_.has_suspension() || warned_of_spring_) return;
  warned_of_spring_ = true;
  const double mass = rig_.sprung_mass(), stiffness = rig_.strut().stiffness,
               damping = rig_.strut().damping, weight = mass * options().number("gravity"),
               deflection = weight / stiffness, radius = wheel_fix_.hub().nominal_radius();
  if (deflection > radius)
    warn(*lmp, fmt::format(
                   "{} is {:g} N/m: under the sprung weight of {:.4g} N it gives by {:.3g} m, more "
                   "than the radius of '{}', {:.3g} m; springs of vehicles give by a tenth of it; "
                   "give N/m, not N/mm",
                   options().where("suspension_stiffness"), stiffness, weight, deflection,
                   wheel_fix_.id, radius));
  const double ratio = 0.5 * damping / std::sqrt(stiffness * mass);
  if (damping > 0.0 && ratio < minimum_damping_ratio)
    warn(*lmp,
         fmt::format("{} is {:g} N s/m, {:.1g} of critical damping; vehicles have 0.2 to 0.4; give "
                     "N s/m, not kN s/m",
                     options().where("suspension_damping"), damping, ratio));
}

/// Warns once, before a run, of a torque that turns nothing.
void FixWheelRig::warn_of_small_torque() {
  const double full = rig_.load() * wheel_fix_.hub().nominal_radius();
  if (warned_of_torque_ || !options().given("torque")) return;
  warned_of_torque_ = true;
  const double torque = std::abs(options().number("torque"));
  if (torque > 0.0 && torque < minimum_torque * full)
    warn(*lmp, fmt::format(
                   "{} is {:g} N m, {:.1g} of load x radius: it hardly turns the wheel; give N m, "
                   "not kN m",
                   options().where("torque"), torque, torque / full));
}

void FixWheelRig::init() {
  warn_of_short_ramps();
  warn_of_soft_spring();
  warn_of_small_torque();
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
  for (const auto* contact : fixes_of<FixUser>(*modify))
    for (const auto* terrain : fixes_of<const Terrain>(*modify))
      if (terrain->moves() && contact->uses(wheel_fix_) && contact->uses(as_fix(*terrain)))
        refuse(as_fix(*terrain));
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
  const std::map<std::string, std::string> before = changed_;
  std::map<std::string, std::string> changed = changed_;
  for (const Entry& target : targets) changed[target.key] = target.values.front();
  retarget(changed);
  FixCoupledSystem& system = FixCoupledSystem::of(*lmp);
  try {
    system.check_targets();
  } catch (const InputError&) {
    retarget(before);
    throw;
  }
  last_change_ = system.time();
}

/// Repeats the line with other values of targets. @throws InputError, and nothing has changed
void FixWheelRig::retarget(const std::map<std::string, std::string>& targets) {
  std::vector<Entry> entries;
  for (const Entry& entry : line_.effective())
    if (line_.given(entry.key) && !targets.count(entry.key)) entries.push_back(entry);
  for (const auto& [key, value] : targets) entries.push_back({key, {value}});
  const Options changed = schema().read(entries);
  rig_.retarget(changed);
  change_options(changed);
  changed_ = targets;
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

/// Finds the wheel of the keyword, if no other rig has it.
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
