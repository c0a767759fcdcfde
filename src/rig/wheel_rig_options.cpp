// SPDX-License-Identifier: GPL-2.0-or-later The keys of a rig, and which of them contradict each
// other.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/core/gravity.h"
#include "furrow/rig/wheel_rig.h"

namespace furrow {

namespace {

// Load over the weight of the wheel: beyond, it does not move, or is shot away.
constexpr double minimum_load = 1e-3, largest_load = 1e5;
// Travel while the wheel settles, over its diameter; with less, the damping of the rig holds the
// wheel.
constexpr double minimum_travel = 1e-3;
// Axle torque over load x radius: no ground bears more.
constexpr double largest_torque = 100.0;
// Drawbar load over the load.
constexpr double largest_drawbar_load = 100.0;
constexpr double largest_speed = 1000.0;     // [m/s] of axle and rim
constexpr double largest_slip_radius = 2.0;  // of the nominal radius
// Speeds [m/s] while the wheel is brought back for another pass
constexpr double largest_return_speed = 100.0, largest_lowering_speed = 10.0;
// Duration of the lowering over settle_time; its largest acceleration over that of the mass under
// the load; largest second derivative of a smooth step over its range
constexpr double largest_lowering_share = 0.25, lowering_acceleration = 0.5,
                 smooth_step_acceleration = 5.78;
// Kinetic energy of the creep, of the work of the load over a hundredth of the radius; end of the
// creep, of settle_time
constexpr double creep_energy = 0.01, creep_share = 0.5;

/// @throws InputError when key is missing (needed) or given (not needed)
void expect_key(const Options& options, const std::string& key, bool needed,
                const std::string& context, const std::string& allowed) {
  if (needed && !options.has(key))
    throw InputError(options.where(key), "is missing " + context, allowed,
                     fmt::format("add '{} <value>'", key));
  if (!needed && options.given(key))
    throw InputError(options.where(key), "is given " + context, allowed,
                     "remove it or change the mode");
}

}  // namespace

Schema WheelRig::schema(const std::string& subject) {
  Schema schema(subject);
  schema.number("load_mass", "kg", Range::positive(), "load as a mass, wheel included").optional();
  schema
      .number("load_force", "N", Range::positive(), "load as a force, the wheel's weight included")
      .optional();
  schema
      .number("sinkage", "m", Range::any(),
              "hub drop to which the wheel is lowered, instead of a load")
      .optional();
  schema
      .choice("travel", {"prescribed", "free"},
              "`prescribed`: the axle moves at `speed`; `free`: forces move it")
      .by_default("prescribed");
  schema
      .number("speed", "m/s", Range::closed(0.0, largest_speed),
              "speed of the axle along x in cruise, with `travel prescribed`")
      .optional();
  schema.choice("mode", {"towed", "slip", "torque", "spin"},
                "`towed`: free spin; `slip`: prescribed slip; `torque`: prescribed axle torque; "
                "`spin`: prescribed spin rate");
  schema.number("slip", "", Range::any(), "slip in `mode slip`; positive when driving").optional();
  schema
      .choice("slip_radius", {"bare", "tip", "effective"},
              "radius that gives v_rim in slip: without grousers, over their tips, or "
              "`effective_radius`")
      .by_default("bare");
  schema
      .number("effective_radius", "m", Range::positive(),
              "radius of slip with `slip_radius effective`")
      .optional();
  schema
      .choice("slip_speed", {"forward", "total"},
              "speed v in slip: `forward`: of the axle in the wheel plane; `total`: its whole "
              "horizontal speed")
      .by_default("forward");
  schema
      .choice("slip_definition", slip_definition_words(),
              "`larger_speed`: (v_rim - v)/max(|v_rim|, |v|); `rim_speed`: (v_rim - v)/v_rim; "
              "`vehicle_speed`: (v_rim - v)/v")
      .by_default("larger_speed");
  schema.number("torque", "N m", Range::any(), "axle torque in `mode torque`; negative brakes")
      .optional();
  schema
      .number("spin_rate", "rad/s", Range::any(),
              "spin rate in `mode spin`; positive rolls forward")
      .optional();
  schema
      .number("drawbar_load", "N", Range::any(),
              "force that holds the axle back along x, with `travel free`; negative pushes")
      .by_default(0.0);
  schema
      .number(
          "dragged_mass", "kg", Range::positive(),
          "mass that moves with the axle, wheel included, with `travel free` or `lateral free`; "
          "by default that of the load")
      .optional();
  schema
      .number("slope", "degrees", Range::closed(-45, 45),
              "slope of the ground along x; positive uphill")
      .by_default(0.0);
  schema
      .number("side_slope", "degrees", Range::closed(-45, 45),
              "slope of the ground along y; positive rises to the left")
      .by_default(0.0);
  schema
      .choice("lateral", {"held", "free"},
              "`held`: no lateral motion; `free`: forces move the axle along y from the "
              "acceleration on")
      .by_default("held");
  schema.integer("passes", Range::closed(1, 1000), "number of passes in the same rut")
      .by_default("1");
  schema
      .number("pass_length", "m", Range::positive(),
              "travel of each pass before the last, with `passes` > 1")
      .optional();
  schema
      .number("return_time", "s", Range::positive(),
              "time to lift, return and lower the wheel, a third each, with `passes` > 1")
      .optional();
  schema
      .number(
          "lift", "m", Range::non_negative(),
          "height above its start at which the wheel returns; by default a tenth of its diameter")
      .optional();
  schema
      .number("slip_angle", "degrees", Range::open(-90, 90),
              "angle from the travel to the wheel plane, about z")
      .by_default(0.0);
  for (const std::string& target : changing_targets()) {
    const Key& constant = *schema.find(target);
    schema
        .numbers(target + "_ramp", 0, "", Range::any(),
                 fmt::format("course of `{}` in cruise: time [s] and value{}, alternately", target,
                             constant.unit.empty() ? "" : " [" + constant.unit + "]"))
        .optional();
  }
  schema
      .number("camber", "degrees", Range::closed(-45, 45),
              "roll angle of the wheel about its heading")
      .by_default(0.0);
  schema
      .number("start", "s", Range::non_negative(),
              "time at which settling begins; the wheel stands still until then")
      .by_default(0.0);
  schema.number("settle_time", "s", Range::positive(), "duration of settling at standstill");
  schema
      .choice(
          "release", {"on_ground", "in_air"},
          "`on_ground`: the rig lowers the wheel to the ground before the load grows; `in_air`: "
          "the wheel falls under the growing load")
      .by_default("on_ground");
  schema
      .number("load_ramp_time", "s", Range::non_negative(),
              "time in which the load grows, at most `settle_time`; by default half of it")
      .optional();
  schema.number("accelerate_time", "s", Range::positive(), "duration of the acceleration");
  schema.number("ground_level", "m", Range::any(),
                "z of the undisturbed ground, the datum of hub drop and rut depth");
  schema
      .number("gravity", "m/s^2", admissible_gravity(), "acceleration of gravity, for `load_mass`")
      .by_default(standard_gravity);
  schema
      .number("damping", "N s/m", Range::non_negative(),
              "viscous damping of the wheel's vertical motion")
      .by_default(0.0);
  schema
      .number("suspension_stiffness", "N/m", Range::positive(),
              "spring between the axle and the mass that it carries; by default rigid, and the "
              "mass without inertia")
      .optional();
  schema.number("suspension_damping", "N s/m", Range::non_negative(), "damper beside this spring")
      .by_default(0.0);
  return schema;
}

WheelRig::WheelRig(const Options& options, WheelHub& wheel, const Courses& table) : wheel_(wheel) {
  ground_level_ = options.number("ground_level");
  const double settle_time = options.number("settle_time");
  load_ramp_ = {options.number("start"), options.has("load_ramp_time")
                                             ? options.number("load_ramp_time")
                                             : 0.5 * settle_time};
  if (load_ramp_.duration > settle_time)
    throw InputError(options.where("load_ramp_time"), fmt::format("is {} s", load_ramp_.duration),
                     fmt::format("0 to settle_time, {} s", settle_time), "lengthen settle_time");
  start_ = load_ramp_.start;
  speed_ramp_ = {start_ + settle_time, options.number("accelerate_time")};

  slope_ = radians(options.number("slope"));
  side_slope_ = radians(options.number("side_slope"));
  lateral_free_ = options.text("lateral") == "free";
  slip_angle_ = radians(options.number("slip_angle"));
  read_courses(options, table);
  check_half_model(options);
  wheel_.place(wheel_.centre(), slip_angle(0.0), radians(options.number("camber")));
  read_slip(options);
  read_vertical(options);
  read_travel(options);
  read_dragged_mass(options);
  read_drive(options);
  read_passes(options);
  read_suspension(options);
  wheel_.set_vertical_damping(options.number("damping"));
  wheel_.set_axle_torque(0.0);
  for (const auto coordinate : {Coordinate::y, Coordinate::yaw, Coordinate::camber})
    wheel_.hold(coordinate);
}

const std::vector<std::string>& WheelRig::changing_targets() {
  static const std::vector<std::string> keys = {"load_force", "slip", "spin_rate", "slip_angle"};
  return keys;
}

void WheelRig::check_half_model(const Options& options) const {
  if (!wheel_.half_model()) return;
  const std::string remedy = "model the whole: 'half no', and ground without symmetry";
  const std::string why = " with a half model, which moves in its plane of symmetry";
  for (const char* key : {"slip_angle", "camber", "side_slope"})
    if (options.number(key) != 0.0)
      throw InputError(options.where(key), fmt::format("is {} degrees{}", options.number(key), why),
                       "0 degrees", remedy);
  if (lateral_free_) throw InputError(options.where("lateral"), "is free" + why, "held", remedy);
  if (has_course("slip_angle"))
    throw InputError(options.where("slip_angle_ramp"), "is given" + why, "no slip angle", remedy);
}

/// Points of the script, alternately time and value, and of the table.
void WheelRig::read_courses(const Options& options, const Courses& table) {
  courses_ = table;
  for (const std::string& target : changing_targets()) {
    const std::string key = target + "_ramp";
    const bool has_ramp = options.given(key);
    if (has_ramp) {
      if (has_course(target))
        throw InputError(options.where(key), "is given, and the table has this target too",
                         "one of the two", "remove the keyword or the column");
      const std::vector<double>& numbers = options.numbers(key);
      if (numbers.size() % 2 != 0)
        throw InputError(options.where(key), fmt::format("has {} numbers", numbers.size()),
                         "pairs of time [s] and value", "write 'slip_ramp 0 0 6 0.6'");
      std::vector<std::pair<double, double>> points;
      for (std::size_t i = 0; i < numbers.size(); i += 2)
        points.emplace_back(numbers[i], numbers[i + 1]);
      courses_.emplace(target, Course(std::move(points)));
    }
    if (!has_course(target)) continue;
    check_course(target,
                 has_ramp ? options.where(key)
                          : fmt::format("{}, table, column '{}'", options.subject(), target),
                 options);
  }
  check_constants(options);
  if (!courses_.empty() && options.integer("passes") > 1)
    throw InputError(options.where("passes"),
                     fmt::format("is {}, and {} changes over time", options.integer("passes"),
                                 courses_.begin()->first),
                     "one pass", "passes are compared under equal conditions");
}

void WheelRig::check_constants(const Options& options) const {
  for (const auto& [target, course] : courses_)
    if (options.given(target))
      throw InputError(options.where(target), "is given, and it changes over time too",
                       "a constant, a ramp or a column of the table", "keep the one that is meant");
}

void WheelRig::check_course(const std::string& target, const std::string& where,
                            const Options& options) const {
  const std::vector<Key>& keys = options.keys();
  const Key& key =
      *std::find_if(keys.begin(), keys.end(), [&](const Key& each) { return each.name == target; });
  double last = -1.0;
  for (const auto& [time, value] : courses_.at(target).points()) {
    if (!(time >= 0.0 && time > last))
      throw InputError(where, fmt::format("has the time {:g} s after {:g} s", time, last),
                       "times >= 0 that grow", "count the time from the start of the cruise");
    if (!key.range.contains(value))
      throw InputError(where, fmt::format("has the value {:g}", value), key.allowed());
    last = time;
  }
}

void WheelRig::read_slip(const Options& options) {
  slip_definition_ = slip_definition(options.text("slip_definition"));
  slip_by_total_speed_ = options.text("slip_speed") == "total";
  const std::string& radius = options.text("slip_radius");
  const bool effective = radius == "effective";
  expect_key(options, "effective_radius", effective, "with slip_radius " + radius,
             "an effective_radius with slip_radius effective, and only there");
  slip_radius_ = effective         ? options.number("effective_radius")
                 : radius == "tip" ? wheel_.tip_radius()
                                   : wheel_.nominal_radius();
  const double ratio = slip_radius_ / wheel_.nominal_radius();
  if (ratio < 1.0 / largest_slip_radius || ratio > largest_slip_radius)
    throw InputError(options.where("effective_radius"), fmt::format("is {:g} m", slip_radius_),
                     fmt::format("{:.4g} to {:.4g} m, about the radius of the wheel",
                                 wheel_.nominal_radius() / largest_slip_radius,
                                 wheel_.nominal_radius() * largest_slip_radius));
}

const std::vector<std::string>& WheelRig::targets() {
  static const std::vector<std::string> keys = {"load_mass", "load_force", "speed",       "slip",
                                                "torque",    "spin_rate",  "drawbar_load"};
  return keys;
}

void WheelRig::retarget(const Options& options) {
  if (passes_.passes() > 1)
    throw InputError(options.where("passes"),
                     fmt::format("is {}, and targets change during the run", passes_.passes()),
                     "one pass", "the passes are planned before the first");
  check_constants(options);
  if (has_suspension() && options.given("load_mass") &&
      options.number("load_mass") * options.number("gravity") != load_)
    throw InputError(options.where("load_mass"), "changes during the run",
                     "the value of the script with a suspension, whose sprung mass it has set",
                     "give the rig a load_force: a change of it leaves the sprung mass as it is");
  const auto read = [&](WheelRig& rig) {
    rig.read_load(options);
    rig.read_travel(options);
    rig.read_drive(options);
  };
  WheelRig trial(*this);
  read(trial);
  read(*this);
  read_dragged_mass(options);  // part of the wheel, which the trial shares
}

void WheelRig::read_load(const Options& options) {
  std::string given;
  int count = 0;
  for (const char* key : {"load_mass", "load_force", "sinkage"})
    if (options.given(key)) given += (count++ ? " and " : "") + std::string(key);
  if (has_course("load_force"))
    given += (count++ ? " and " : "") + std::string("a course of load_force");
  if (count != 1)
    throw InputError(options.subject(), count == 0 ? "has no load" : fmt::format("has {}", given),
                     "exactly one of load_mass [kg], load_force [N], sinkage [m]",
                     count == 0
                         ? "give the load that the ground carries, weight of the wheel included"
                         : "keep the one that is meant");
  sinkage_prescribed_ = options.given("sinkage");
  if (options.given("load_mass")) load_ = options.number("load_mass") * options.number("gravity");
  if (options.given("load_force")) load_ = options.number("load_force");
  if (!has_course("load_force")) {
    check_load(options);
    return;
  }
  const auto& points = courses_.at("load_force").points();
  for (auto point = points.rbegin(); point != points.rend(); ++point) {  // the first remains
    load_ = point->second;
    check_load(options);
  }
}

void WheelRig::read_vertical(const Options& options) {
  read_load(options);
  if (sinkage_prescribed_ && load_ramp_.duration == 0.0)
    throw InputError(options.where("load_ramp_time"), "is 0 s with a prescribed sinkage",
                     "a number > 0 [s]", "the wheel needs time to go down");
  if (sinkage_prescribed_)
    lowering_ = ground_level_ - options.number("sinkage") - wheel_.lowest_point();
  lowers_ = !sinkage_prescribed_ && options.text("release") == "on_ground";
  if (lowers_) plan_lowering(options.number("settle_time"));
}

/// The load grows once the wheel is down.
void WheelRig::plan_lowering(double settle_time) {
  const double gap = std::max(0.0, wheel_.lowest_point() - ground_level_),
               acceleration = lowering_acceleration * load_ / wheel_.total_mass();
  touching_z_ = wheel_.position(Coordinate::z) - gap;
  lowering_ramp_ = {start_, std::min(largest_lowering_share * settle_time,
                                     std::sqrt(smooth_step_acceleration * gap / acceleration))};
  load_ramp_.start = lowering_ramp_.end();
  creep_end_ = start_ + creep_share * settle_time;
  load_ramp_.duration = std::min(load_ramp_.duration, speed_ramp_.start - load_ramp_.start);
  // kinetic energy over the work of the load on a hundredth of the radius
  creep_speed_ =
      std::sqrt(2.0 * creep_energy * 0.01 * wheel_.nominal_radius() * load_ / wheel_.total_mass());
}

void WheelRig::check_load(const Options& options) const {
  if (sinkage_prescribed_) {
    const double diameter = 2.0 * wheel_.nominal_radius();
    if (std::abs(options.number("sinkage")) > diameter)
      throw InputError(
          options.where("sinkage"), fmt::format("is {} m", options.number("sinkage")),
          fmt::format("-{:.4g} to {:.4g} m, the diameter of the wheel", diameter, diameter));
    return;
  }
  const double share = load_ / (wheel_.total_mass() * standard_gravity);
  if (!(share >= minimum_load && share <= largest_load))
    throw InputError(
        options.where(options.given("load_mass") ? "load_mass"
                      : has_course("load_force") ? "load_force_ramp"
                                                 : "load_force"),
        fmt::format("makes {:.4g} N, {:.3g} of the weight of the wheel's own {:.4g} kg", load_,
                    share, wheel_.total_mass()),
        fmt::format("{:g} to {:g} of it", minimum_load, largest_load),
        "check the load and the mass of the wheel: what hangs on the axle is part of its mass");
  const double settle_time = options.number("settle_time"), damping = options.number("damping"),
               travel = load_ * settle_time / damping,
               least = minimum_travel * 2.0 * wheel_.nominal_radius();
  if (travel < least)
    throw InputError(options.where("damping"),
                     fmt::format("is {:g} N s/m: under {:.4g} N the wheel goes down by {:.3g} m in "
                                 "a settle_time of {:g} s",
                                 damping, load_, travel, settle_time),
                     fmt::format("at most {:.3g} N s/m", load_ * settle_time / least),
                     "damping is meant to calm the wheel, not to stop it");
}

void WheelRig::read_travel(const Options& options) {
  travel_free_ = options.text("travel") == "free";
  const std::string context = fmt::format("with travel {}", options.text("travel"));
  expect_key(options, "speed", !travel_free_, context,
             "a speed with travel prescribed, and only there");
  if (!travel_free_) {
    expect_key(options, "drawbar_load", false, context, "only with travel free");
    if (!lateral_free_)
      expect_key(options, "dragged_mass", false, context + " and lateral held",
                 "only with travel free or lateral free");
    speed_ = options.number("speed");
  }
  if (sinkage_prescribed_ && lateral_free_)
    throw InputError(options.where("lateral"), "is free with a prescribed sinkage",
                     "lateral free with load_mass or load_force", "give a load");
  if (!travel_free_) return;
  if (sinkage_prescribed_)
    throw InputError(options.where("travel"), "is free with a prescribed sinkage",
                     "travel free with load_mass or load_force",
                     "give a load: its weight drives the wheel on a slope");
  drawbar_load_ = options.number("drawbar_load");
  const double most = largest_drawbar_load * load_;
  if (std::abs(drawbar_load_) > most)
    throw InputError(
        options.where("drawbar_load"),
        fmt::format("is {:g} N under a load of {:.4g} N", drawbar_load_, load_),
        fmt::format("{:.3g} to {:.3g} N, {:g} times the load", -most, most, largest_drawbar_load),
        "the ground resists about the load at most");
}

void WheelRig::read_dragged_mass(const Options& options) {
  if (!travel_free_ && !lateral_free_) return;
  const double own = wheel_.total_mass();
  const double dragged = options.has("dragged_mass")
                             ? options.number("dragged_mass")
                             : std::max(own, load_ / options.number("gravity"));
  if (dragged < own)
    throw InputError(options.where("dragged_mass"), fmt::format("is {:g} kg", dragged),
                     fmt::format("at least {:.4g} kg, the mass of the wheel", own),
                     "the wheel is part of what moves");
  wheel_.set_dragged_mass(dragged - own);
}

void WheelRig::read_drive(const Options& options) {
  const std::string& mode = options.text("mode");
  mode_ = mode == "towed"    ? Mode::towed
          : mode == "slip"   ? Mode::slip
          : mode == "torque" ? Mode::torque
                             : Mode::spin;
  const std::string context = fmt::format("in mode {}", mode);
  const auto expect_target = [&](const std::string& key, Mode mode, const std::string& allowed) {
    if (has_course(key) && mode_ != mode)
      throw InputError(options.where(key), "changes over time " + context, allowed,
                       "remove its ramp or column, or change the mode");
    if (!has_course(key)) expect_key(options, key, mode_ == mode, context, allowed);
  };
  expect_target("slip", Mode::slip, "a slip in mode slip, and only there");
  expect_key(options, "slip_definition", mode_ == Mode::slip, context,
             "a slip_definition in mode slip, and only there");
  expect_key(options, "torque", mode_ == Mode::torque, context,
             "a torque in mode torque, and only there");
  expect_target("spin_rate", Mode::spin, "a spin_rate in mode spin, and only there");
  if (mode_ == Mode::torque) torque_ = options.number("torque");
  const auto values_of = [&](const std::string& key) {
    std::vector<double> values;
    if (!has_course(key)) return std::vector<double>{options.number(key)};
    for (const auto& point : courses_.at(key).points()) values.push_back(point.second);
    return values;
  };
  if (mode_ == Mode::spin)
    for (const double rate : values_of("spin_rate"))
      if (const double most = largest_speed / wheel_.nominal_radius(); std::abs(rate) > most)
        throw InputError(options.where("spin_rate"),
                         fmt::format("is {:g} rad/s: a rim speed of {:.3g} m/s", rate,
                                     rate * wheel_.nominal_radius()),
                         fmt::format("{:.3g} to {:.3g} rad/s", -most, most));
  if (mode_ == Mode::spin) spin_rate_ = values_of("spin_rate").front();
  const double most = largest_torque * load_ * wheel_.nominal_radius();
  if (!sinkage_prescribed_ && std::abs(torque_) > most)
    throw InputError(
        options.where("torque"),
        fmt::format("is {:g} N m under a load of {:.4g} N", torque_, load_),
        fmt::format("{:.3g} to {:.3g} N m, {:g} times load x radius", -most, most, largest_torque),
        "the ground resists about load x radius at most");
  if (mode_ != Mode::slip) return;
  if (travel_free_)
    throw InputError(options.where("mode"), "is slip with travel free",
                     "towed, torque or spin: with travel free the slip is an answer",
                     "write 'mode spin spin_rate <rad/s>', or 'travel prescribed'");
  if (speed_ == 0.0)
    throw InputError(options.where("speed"), "is 0 m/s in mode slip", "a number > 0 [m/s]",
                     "give a speed, or drive a standing wheel with mode torque");
  const std::vector<double> slips = values_of("slip");
  for (auto slip = slips.rbegin(); slip != slips.rend(); ++slip) {  // the first remains
    slip_ = *slip;
    try {
      spin_rate_ = spin_rate_of(slip_, slip_angle(0.0));
    } catch (const StateError&) {
      throw InputError(
          options.where("slip"),
          fmt::format("is {} with slip_definition {}", slip_, options.text("slip_definition")),
          "-1 to below 1 by the larger speed, below 1 by rim speed, at least -1 by vehicle speed",
          "a wheel that spins on the spot or backwards needs mode torque");
    }
  }
}

void WheelRig::read_suspension(const Options& options) {
  const bool given = options.has("suspension_stiffness");
  if (!given) {
    expect_key(options, "suspension_damping", false, "without suspension_stiffness",
               "only with suspension_stiffness");
    return;
  }
  const std::string where = options.where("suspension_stiffness");
  if (passes_.passes() > 1 || sinkage_prescribed_)
    throw InputError(where, "is given with passes or a prescribed sinkage", "one pass and a load",
                     "remove it, or the other keyword");
  const double gravity = options.number("gravity"), own = wheel_.total_mass();
  const double sprung = load_ / gravity - own;
  if (!(sprung > 0.0))
    throw InputError(where, fmt::format("is given, and the load is {:.4g} kg", load_ / gravity),
                     fmt::format("a load above {:.4g} kg, the mass of the wheel", own),
                     "the mass of the wheel is unsprung, the rest of the load is sprung");
  sprung_mass_ = sprung;
  strut_.stiffness = options.number("suspension_stiffness");
  strut_.damping = options.number("suspension_damping");
  wheel_weight_ = own * gravity;
  start_height_ = first_height_ = wheel_.position(Coordinate::z);
}

void WheelRig::read_passes(const Options& options) {
  const int passes = static_cast<int>(options.integer("passes"));
  const bool several = passes > 1;
  const std::string context = fmt::format("with passes {}", passes);
  for (const char* key : {"pass_length", "return_time"})
    expect_key(options, key, several, context, "with passes > 1, and only there");
  if (!several) {
    expect_key(options, "lift", false, context, "with passes > 1, and only there");
    return;
  }
  if (travel_free_ || lateral_free_ || sinkage_prescribed_)
    throw InputError(options.where("passes"),
                     fmt::format("is {} with {}", passes,
                                 travel_free_    ? "travel free"
                                 : lateral_free_ ? "lateral free"
                                                 : "a prescribed sinkage"),
                     "1, or more with a speed and a load",
                     "passes are compared at the same speed and load");
  const double least = speed_ * speed_ramp_.integral(speed_ramp_.end());
  const double length = options.number("pass_length");
  if (!(speed_ > 0.0 && length > least))
    throw InputError(options.where("pass_length"), fmt::format("is {:g} m", length),
                     speed_ > 0.0
                         ? fmt::format("more than {:.4g} m, the travel of the acceleration", least)
                         : std::string("a speed > 0"),
                     "each pass needs a cruise");
  const double back = options.number("return_time");
  passes_ =
      PassSchedule(passes, start_, speed_ramp_.end() - start_ + (length - least) / speed_, back);
  const double diameter = 2.0 * wheel_.nominal_radius();
  const double lift = options.has("lift") ? options.number("lift") : 0.1 * diameter;
  first_x_ = wheel_.centre().x();
  lifted_z_ = wheel_.centre().z() + lift;
  // to half a diameter below the start in most of the time for it
  lowering_speed_ = (lift + 0.5 * diameter) / (0.9 * passes_.lowering().duration);
  const double minimum_time =
      back * std::max(lowering_speed_ / largest_lowering_speed,
                      length / passes_.returning().duration / largest_return_speed);
  if (back < minimum_time)
    throw InputError(
        options.where("return_time"),
        fmt::format("is {:g} s: the wheel goes back by {:.4g} m at {:.3g} m/s and down from a lift "
                    "of {:.3g} m at {:.3g} m/s",
                    back, length, length / passes_.returning().duration, lift, lowering_speed_),
        fmt::format("at least {:.3g} s: {:g} m/s back and {:g} m/s down", minimum_time,
                    largest_return_speed, largest_lowering_speed));
}

}  // namespace furrow
