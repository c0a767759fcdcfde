// SPDX-License-Identifier: GPL-2.0-or-later
// Rules for what moves: does one fix, and only one, move each grain; do wheels and plates move at
// speeds that the ground and the step can follow?

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "atom.h"
#include "furrow/core/communicator.h"
#include "furrow/core/gravity.h"
#include "furrow/core/types.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/base/roles/grain_bed.h"
#include "coupling/base/checks/grain_check.h"
#include "coupling/wheels/fix_plate_rigid.h"
#include "coupling/base/fix_wheel_hub.h"
#include "coupling/checks/scene_checks.h"
#include "coupling/contact/grains/grain_bed_check.h"
#include "coupling/drive/fix_wheel_rig.h"
#include "coupling/laboratory/fix_cell_servo.h"

namespace furrow::coupling {

namespace {

constexpr char move_all[] = "write 'fix move all nve/sphere'";
// Downward share of gravity: a slope of 60 degrees, steeper than any ground stands.
constexpr double minimum_downward_share = 0.5;
constexpr double straight = 1.0;  // [degrees] of gravity from straight down
// Gravity [m/s^2] of planets and moons that a vehicle may roll on, by a wide margin.
const Range usual_gravity = Range::closed(0.05, 30.0);
// Load over width and length of the body [Pa]; tyres of lorries have 1e5, of aircraft 4e5.
const Range usual_pressure = Range::closed(20.0, 5e5);
// Mass of a wheel, which includes all that hangs on the axle. If the wheel is heavier than a solid
// one of steel [kg/m^3], and than its load by this factor, its mass is in other units.
constexpr double solid_steel = 7850.0, usual_lift = 1.5;
// Difference between two values of one gravity, over the larger.
constexpr double same_gravity = 2e-3, similar_gravity = 0.05;
constexpr double same_pace = 1e-9;  // of speeds and times of two rigs
// Speed over sqrt(g length of the body), and on a rigid plane [m/s]: beyond, it is in another unit.
constexpr double usual_froude = 1.0, usual_road_speed = 70.0;
// speed of a body over the wave speed
constexpr double mach_warning = 0.3, mach_limit = 1.0;
// travel in a step over the radius of the smallest grain
constexpr double travel_warning = 0.1, travel_limit = 1.0;

struct GivenSpeed {
  const Options& options;
  std::string key, unit;
  double value() const { return options.number(key); }
};

/// Refuses a share of a limit, or warns of it.
CheckResult check_share(double share, double warned, double limit, const GivenSpeed& speed,
                        const std::string& finding, const std::string& remedy) {
  const std::string where = speed.options.where(speed.key);
  const std::string problem = fmt::format("is {:.4g} {}, {}", speed.value(), speed.unit, finding);
  if (share > limit)
    return refusal(
        where, problem,
        fmt::format("at most {:.3g} {} here", limit / share * std::abs(speed.value()), speed.unit),
        remedy);
  if (share > warned) return warning(fmt::format("{} {}; {}", where, problem, remedy));
  return {};
}

double wave_speed(const ContinuumTerrain& terrain) {
  return terrain.parameters().cfl * terrain.grid().shortest_cell() / terrain.stable_time_step();
}

/// Every gravity that a line of the scene uses. A rig uses it where it is given, or makes a force
/// of a mass or a mass of a force.
std::vector<GivenGravity> gravities(const Scene& scene) {
  const LAMMPS_NS::Modify& modify = *scene.lammps.modify;
  std::vector<GivenGravity> given;
  for (const Ground* ground : Grounds(scene.lammps))
    for (const GivenGravity& gravity : ground->gravities()) given.push_back(gravity);
  for (const auto* rig : fixes_of<const FixWheelRig>(modify)) {
    const Options& options = rig->options();
    if (options.given("gravity") || options.given("load_mass") ||
        options.has("suspension_stiffness") || options.text("travel") == "free" ||
        options.text("lateral") == "free")
      given.push_back({options.where("gravity"), {0.0, 0.0, -options.number("gravity")}});
  }
  return given;
}

/// Angle of gravity from straight down [degrees]; 0 without gravity.
double angle_from_down(const Vector3& gravity) {
  return gravity.norm() > 0.0 ? degrees(std::acos(-gravity.z() / gravity.norm())) : 0.0;
}

bool touches_plane_only(const Scene& scene, const FixBody& body) {
  const LAMMPS_NS::Modify& modify = *scene.lammps.modify;
  const auto on_body = [&](const auto* contact) { return contact->uses(body); };
  const auto planes = fixes_of<const FixContactPlane>(modify);
  const auto grounds = fixes_of<const FixGroundContact>(modify);
  return std::any_of(planes.begin(), planes.end(), on_body) &&
         std::none_of(grounds.begin(), grounds.end(), on_body) &&
         !touches_grains(scene.lammps, body);
}

bool rolls_on(const Scene& scene, const FixWheelRig& rig, const FixTerrain& terrain) {
  if (terrain.uses(rig.wheel_fix())) return true;
  const auto contacts = fixes_of<const FixContactContinuum>(*scene.lammps.modify);
  return std::any_of(contacts.begin(), contacts.end(), [&](const FixContactContinuum* contact) {
    return contact->uses(rig.wheel_fix()) && contact->uses(terrain);
  });
}

/// @return the key of a constant load, or ""
const char* key_of_load(const Options& options) {
  for (const char* name : {"load_mass", "load_force", "load"})
    if (options.has(name)) return name;
  return "";
}

/// Load of a rig, from a force or from a mass and gravity [N].
double load_from(const Options& options) {
  const bool mass = options.has("load_mass");
  return options.number(key_of_load(options)) * (mass ? options.number("gravity") : 1.0);
}

}  // namespace

std::vector<DrivenBody> driven_bodies(const LAMMPS_NS::Modify& modify) {
  std::vector<DrivenBody> driven;
  for (auto* rig : fixes_of<FixWheelRig>(modify))
    driven.push_back({rig->wheel_fix(), rig->options(), rig->rig().cruise_start(),
                      "start, settle_time and accelerate_time"});
  for (auto* plate : fixes_of<FixPlateRigid>(modify))
    driven.push_back({*plate, plate->options(), plate->full_speed(), "start and accelerate_time"});
  return driven;
}

CheckResult moved_mesh_has_no_body(const Scene&, LAMMPS_NS::FixMoveMesh& motion) {
  const auto* mesh = dynamic_cast<const FixMeshBody*>(motion.fixMesh());
  if (!mesh) return {};
  return refusal(fmt::format("fix {} '{}'", motion.style, motion.id),
                 fmt::format("moves the mesh/body '{}', which follows its body", mesh->id),
                 "a mesh that no body has", "drive the body: by a wheel/rig, or as a plate/rigid");
}

CheckResult grains_turn(const Scene& scene, const LAMMPS_NS::Fix& mover) {
  if (scene.lammps.atom->natoms == 0 || mover.style != std::string("nve")) return {};
  return warning(fmt::format(
      "fix nve '{}' moves grains and does not turn them, whatever torque they have; write "
      "'nve/sphere'",
      mover.id));
}

CheckResult one_fix_moves_a_grain(const Scene& scene) {
  const LAMMPS_NS::Atom& atom = *scene.lammps.atom;
  std::vector<const LAMMPS_NS::Fix*> movers;
  for (const auto* fix : fixes_of<const LAMMPS_NS::Fix>(*scene.lammps.modify))
    if (fix->time_integrate != 0) movers.push_back(fix);
  for (std::size_t a = 0; a < movers.size(); ++a)
    for (std::size_t b = a + 1; b < movers.size(); ++b) {
      const LAMMPS_NS::Fix &first = *movers[a], &second = *movers[b];
      double both = 0.0;
      for (int i = 0; i < atom.nlocal; ++i)
        if ((atom.mask[i] & first.groupbit) && (atom.mask[i] & second.groupbit)) both += 1.0;
      both = Communicator(&scene.lammps.world).sum(both);
      if (both > 0.0)
        return refusal(
            fmt::format("fix {} '{}'", second.style, second.id),
            fmt::format("moves {:.0f} grain(s) that fix {} '{}' moves already", both, first.style,
                        first.id),
            "one such fix for each grain",
            fmt::format("remove one of the lines, write 'unfix {}' before, or give them groups "
                        "without a common grain",
                        first.id));
    }
  return {};
}

CheckResult bed_has_one_weight(const Scene& scene) {
  const LAMMPS_NS::Modify& modify = *scene.lammps.modify;
  if (scene.grains < GrainBedLimits::min_grains || fixes_of<const FixWallGranBody>(modify).empty())
    return {};
  const std::size_t count = fixes_of<LAMMPS_NS::FixGravity>(modify).size();
  if (count == 0)
    return warning(
        "no fix gives the grains weight; write 'fix weight all gravity 9.80665 vector 0 0 -1'");
  if (count > 1)
    return warning(
        fmt::format("{} fixes gravity act together; grains have that many weights", count));
  return {};
}

CheckResult some_fix_moves_a_grain(const Scene& scene) {
  const LAMMPS_NS::Atom& atom = *scene.lammps.atom;
  int moved_or_frozen = 0;  // bits of their groups
  for (const auto* fix : fixes_of<const LAMMPS_NS::Fix>(*scene.lammps.modify))
    if (moves_grains(*fix) || freezes_grains(*fix)) moved_or_frozen |= fix->groupbit;
  double still = 0.0;
  for (int i = 0; i < atom.nlocal; ++i)
    if (!(atom.mask[i] & moved_or_frozen)) still += 1.0;
  still = Communicator(&scene.lammps.world).sum(still);
  if (still == 0.0) return {};
  const auto walls = fixes_of<const FixWallGranBody>(*scene.lammps.modify);
  if (still == scene.grains && still >= GrainBedLimits::min_grains && !walls.empty())
    return refusal(
        fmt::format("fix wall/gran/body '{}'", walls.front()->id),
        fmt::format("presses on grains, and no fix moves any of the {:.0f}", still),
        "grains that a fix moves or freezes",
        fmt::format("{}, or 'fix still all freeze' for grains that stand still", move_all));
  return warning(
      fmt::format("no fix moves {:.0f} of {:.0f} grains: they stand still; {}, or 'fix still "
                  "<group> freeze' if that is meant",
                  still, scene.grains, move_all));
}

CheckResult weight_pulls_down(const Scene& scene, LAMMPS_NS::FixGravity& gravity) {
  if (scene.lammps.atom->natoms == 0) return {};
  Vector3 weight;
  gravity.get_gravity(weight.data());
  if (weight.norm() == 0.0)
    return warning(
        fmt::format("fix gravity '{}' is 0: grains have no weight and bear nothing; write 9.80665, "
                    "or remove the line if that is meant",
                    gravity.id));
  if (-weight.z() >= minimum_downward_share * weight.norm()) return {};
  return warning(
      fmt::format("fix gravity '{}' is {:.4g} {:.4g} {:.4g} m/s^2, which does not pull grains "
                  "down; down is 'vector 0 0 -1'",
                  gravity.id, weight.x(), weight.y(), weight.z()));
}

CheckResult scene_has_one_gravity(const Scene& scene) {
  const std::vector<GivenGravity> given = gravities(scene);
  const double largest_gravity = admissible_gravity().upper;
  for (const GivenGravity& each : given)
    if (each.vector.norm() > largest_gravity)
      return refusal(each.where, fmt::format("is {:.4g} m/s^2", each.vector.norm()),
                     fmt::format("at most {:g} m/s^2", largest_gravity), "on Earth it is 9.80665");
  for (const GivenGravity& each : given)
    if (each.vector.norm() > 0.0 && !usual_gravity.contains(each.vector.norm()))
      return warning(fmt::format(
          "{} is {:.4g} m/s^2; planets and moons have one {}, Earth 9.80665; give m/s^2",
          each.where, each.vector.norm(), usual_gravity.text()));
  for (std::size_t n = 1; n < given.size(); ++n) {
    const double one = given[n].vector.norm(), other = given[0].vector.norm();
    const double difference = std::abs(one - other) / std::max(one, other);
    if (!(difference > same_gravity)) continue;
    Finding found =
        warning(fmt::format("{} is {:.4g} m/s^2, and {} is {:.4g} m/s^2; write one gravity for "
                            "terrain, grains and rigs",
                            given[n].where, one, given[0].where, other));
    found.stops = difference > similar_gravity && one > 0.0 && other > 0.0;
    return found;
  }
  return {};
}

/// A rig's slope turns the gravity of terrain and grains, which a tilted vector would turn again.
CheckResult slope_is_given_once(const Scene& scene) {
  if (scene.grains == 0.0) return {};
  const LAMMPS_NS::Modify& modify = *scene.lammps.modify;
  for (auto* fix : fixes_of<LAMMPS_NS::FixGravity>(modify)) {
    Vector3 gravity;
    fix->get_gravity(gravity.data());
    const double angle = angle_from_down(gravity);
    if (angle <= straight) continue;
    const std::string problem =
        fmt::format("pulls along {:.4g} {:.4g} {:.4g} m/s^2, {:.3g} degrees from straight down",
                    gravity.x(), gravity.y(), gravity.z(), angle);
    const std::string where = fmt::format("fix gravity '{}'", fix->id);
    for (const auto* rig : fixes_of<const FixWheelRig>(modify))
      if (rig->rig().on_slope())
        return refusal(where, fmt::format("{}, and fix {} has a slope", problem, rig->id),
                       "one of the two", "write 'vector 0 0 -1' and keep the slope");
    for (const auto* terrain : fixes_of<const Terrain>(modify))
      for (const GivenGravity& given : terrain->gravities())
        if (given.vector.norm() > 0.0)
          return refusal(
              where,
              fmt::format("{}, and that of {} straight down", problem, name_of(as_fix(*terrain))),
              "one direction for grains and terrain",
              "write 'vector 0 0 -1', and for a slope 'slope' in the line of the rig");
    const double across = degrees(std::asin(std::abs(gravity.y()) / gravity.norm()));
    if (across > straight && -gravity.z() >= minimum_downward_share * gravity.norm())
      return warning(fmt::format(
          "{} {}: the ground slopes across the travel; if that is not meant, write 'vector 0 0 -1'",
          where, problem));
  }
  return {};
}

/// Terrain that follows a row of wheels is where their middle is.
CheckResult wheels_on_moving_terrain_keep_pace(const Scene& scene, const FixTerrain& terrain) {
  if (!terrain.moves()) return {};
  const FixWheelRig* first = nullptr;
  for (const auto* rig : fixes_of<const FixWheelRig>(*scene.lammps.modify)) {
    if (rig->options().text("travel") == "free" || !rolls_on(scene, *rig, terrain)) continue;
    if (!first) first = rig;
    for (const char* key : {"speed", "start", "settle_time", "accelerate_time"}) {
      const double one = rig->options().number(key), other = first->options().number(key);
      if (std::abs(one - other) <= same_pace * std::max(one, other)) continue;
      return refusal(rig->options().where(key),
                     fmt::format("is {:g}, and that of '{}' is {:g}: both roll on terrain '{}', "
                                 "which follows them",
                                 one, first->id, other, terrain.id),
                     "wheels that keep their distance",
                     fmt::format("write '{} {:g}', or terrain without 'follow'", key, other));
    }
  }
  return {};
}

CheckResult body_sets_off(const Scene& scene, const DrivenBody& driven) {
  const double start = driven.options.number("start");
  if (start < scene.end()) return {};
  return warning(
      fmt::format("{} is {:.4g} s: this run ends before, and '{}' does not set off; make it "
                  "smaller, or the run longer",
                  driven.options.where("start"), start, driven.body.id));
}

CheckResult body_comes_to_its_speed(const Scene& scene, const DrivenBody& driven) {
  const double end = scene.end();
  const bool stands = driven.options.has("speed") && !(driven.options.number("speed") > 0.0);
  if (driven.options.number("start") >= end || stands ||
      driven.full_speed <= end + 0.5 * scene.step())
    return {};
  return warning(
      fmt::format("{}: '{}' has its speed from {:.4g} s on, after the end of this run, which "
                  "then has no steady values; run longer, or shorten {}",
                  driven.options.subject(), driven.body.id, driven.full_speed, driven.stages));
}

CheckResult waves_outrun_body(const Scene& scene, FixContactContinuum& contact) {
  for (const DrivenBody& driven : driven_bodies(*scene.lammps.modify)) {
    // the speed of free travel is a result
    if (&contact.body_fix() != &driven.body) continue;
    const double wave = wave_speed(contact.terrain_fix().terrain());
    const auto check_speed = [&](const GivenSpeed& speed, double radius) {
      const double share = std::abs(speed.value()) * radius / wave;
      return check_share(share, mach_warning, mach_limit, speed,
                         fmt::format("{:.2g} of the speed of waves in the terrain '{}', {:.4g} m/s",
                                     share, contact.terrain_fix().id, wave),
                         "choose a lower speed, or a modulus_scale nearer to 1");
    };
    if (driven.options.has("speed"))
      if (const CheckResult found = check_speed({driven.options, "speed", "m/s"}, 1.0))
        return found;
    const auto* wheel = dynamic_cast<const WheelHub*>(&driven.body.body());
    if (wheel && driven.options.has("spin_rate"))
      return check_speed({driven.options, "spin_rate", "rad/s"}, wheel->nominal_radius());
  }
  return {};
}

CheckResult speed_suits_the_ground(const Scene& scene, const DrivenBody& driven) {
  const Options& options = driven.options;
  const auto* wheel = dynamic_cast<const WheelHub*>(&driven.body.body());
  const bool moves = options.has("speed");
  if (!moves && !(wheel && options.has("spin_rate"))) return {};
  const GivenSpeed given{options, moves ? "speed" : "spin_rate", moves ? "m/s" : "rad/s"};
  const double speed = std::abs(given.value()) * (moves ? 1.0 : wheel->nominal_radius());
  const auto [lower, upper] = driven.body.body().surface().bounds();
  const double gravity = options.has("gravity") ? options.number("gravity") : standard_gravity;
  const double usual = touches_plane_only(scene, driven.body)
                           ? usual_road_speed
                           : usual_froude * std::sqrt(gravity * (upper.x() - lower.x()));
  if (speed <= usual) return {};
  const std::string units =
      moves ? fmt::format("m/s; {0:g} km/h are {1:.4g}, {0:g} cm/s are {2:.4g}", given.value(),
                          given.value() / 3.6, given.value() / 100.0)
            : fmt::format("rad/s; {0:g} rpm are {1:.4g}, {0:g} degrees/s are {2:.4g}",
                          given.value(), given.value() * pi / 30.0, radians(given.value()));
  return warning(fmt::format(
      "{} is {:.4g} {}, and '{}' usually has at most {:.2g} m/s here; faster, the inertia of the "
      "ground counts; give {}",
      options.where(given.key), given.value(),
      moves ? "m/s" : fmt::format("rad/s, a rim speed of {:.3g} m/s", speed), driven.body.id, usual,
      units));
}

CheckResult sinkage_ends_above_the_base(const Scene& scene, FixContactContinuum& contact) {
  const double depth = contact.terrain_fix().options().number("depth");
  for (const DrivenBody& driven : driven_bodies(*scene.lammps.modify)) {
    if (&contact.body_fix() != &driven.body || !driven.options.has("sinkage")) continue;
    const double sinkage = driven.options.number("sinkage");
    if (sinkage < depth) continue;
    return refusal(driven.options.where("sinkage"),
                   fmt::format("is {:g} m, and terrain '{}' is {:g} m deep", sinkage,
                               contact.terrain_fix().id, depth),
                   "less than the depth of the terrain", "give both in m");
  }
  return {};
}

CheckResult load_suits_the_body(const Scene&, const DrivenBody& driven) {
  const Options& options = driven.options;
  const char* key = key_of_load(options);
  if (!*key) return {};
  const double load = load_from(options);
  const Body& body = driven.body.body();
  const auto [lower, upper] = body.surface().bounds();
  const Vector3 size = upper - lower;
  const double pressure = load / (size.x() * size.y() * (body.half_model() ? 2.0 : 1.0));
  if (usual_pressure.contains(pressure)) return {};
  return warning(fmt::format(
      "{} makes {:.4g} N, {:.3g} Pa over length and width of '{}'; wheels, tyres and plates have "
      "{} Pa; give kg or N, and its size in m",
      options.where(key), load, pressure, driven.body.id, usual_pressure.text()));
}

CheckResult mass_suits_the_load(const Scene&, const DrivenBody& driven) {
  const auto* wheel = dynamic_cast<const WheelHub*>(&driven.body.body());
  if (!wheel || !*key_of_load(driven.options)) return {};
  const double radius = wheel->nominal_radius(), mass = wheel->total_mass(),
               load = load_from(driven.options), weight = mass * driven.options.number("gravity"),
               density = mass / (pi * radius * radius * wheel->nominal_width());
  if (density <= solid_steel || weight <= usual_lift * load) return {};
  return warning(fmt::format(
      "'{}' has {:.4g} kg, {:.3g} times the mass of a solid wheel of steel with its radius and "
      "width, and {:.3g} times that of its load of {:.4g} N; check the mass in kg and the size in "
      "m",
      driven.body.id, mass, density / solid_steel, weight / load, load));
}

CheckResult body_passes_no_grain_in_a_step(const Scene& scene, const DrivenBody& driven) {
  if (!driven.options.has("speed") || !touches_grains(scene.lammps, driven.body)) return {};
  const LAMMPS_NS::Atom& atom = *scene.lammps.atom;
  double smallest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < atom.nlocal; ++i) smallest = std::min(smallest, atom.radius[i]);
  smallest = -Communicator(&scene.lammps.world).max(-smallest);
  const double share = driven.options.number("speed") * scene.step() / smallest;
  return check_share(
      share, travel_warning, travel_limit, {driven.options, "speed", "m/s"},
      fmt::format("so that the body moves by {:.2g} radii of the smallest grain in a step", share),
      "choose a lower speed or a shorter timestep");
}

}  // namespace furrow::coupling
