// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/rig/chassis.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

constexpr double apart = 1e-6;            // [m] wheels that are closer are in one line
constexpr double maximum_radii = 10.0;    // of a wheel, of heights above the axles
constexpr double minimum_support = 1e-6;  // of the stiffest coordinate
constexpr double closed_gap = 0.5;        // share of an error of distance that a step takes back

/// Centre of the sprung masses in x and y [m].
Vector2 centre_of_mass(const std::vector<WheelRig*>& rigs) {
  Vector2 sum = Vector2::Zero();
  double mass = 0.0;
  for (const WheelRig* rig : rigs) {
    sum += rig->sprung_mass() * rig->wheel().centre().head<2>();
    mass += rig->sprung_mass();
  }
  return sum / mass;
}

/// @throws InputError for an inertia of a body that cannot turn, or none of one that can
double inertia_of(const Options& options, const std::string& key, double span, const char* axis) {
  const bool turns = span > apart;
  if (turns && !options.has(key))
    throw InputError(
        options.where(key),
        fmt::format("is missing, and the wheels are {:.4g} m apart along {}", span, axis),
        "a number > 0 [kg m^2]", "give the inertia of the body about its centre of mass");
  if (!turns && options.has(key))
    throw InputError(options.where(key),
                     fmt::format("is given, and all wheels have the same {}", axis),
                     fmt::format("wheels apart along {}", axis), "remove it");
  return turns ? options.number(key) : 0.0;
}

}  // namespace

Schema Chassis::schema(const std::string& subject) {
  Schema schema(subject);
  schema.text("rigs", "ids of the fixes wheel/rig with suspension, with commas between them");
  schema
      .number("roll_inertia", "kg m^2", Range::positive(),
              "about x, for wheels that are apart along y")
      .optional();
  schema
      .number("pitch_inertia", "kg m^2", Range::positive(),
              "about y, for wheels that are apart along x")
      .optional();
  schema.number("height", "m", Range::any(), "height of the centre of mass above the axles")
      .by_default(0.0);
  schema
      .number("guide_height", "m", Range::any(),
              "height above the axles at which the rigs pull and guide the body")
      .by_default(0.0);
  return schema;
}

SprungBody Chassis::make_body(const Options& options, const std::vector<WheelRig*>& rigs) {
  double mass = 0.0;
  Vector2 least = rigs.front()->wheel().centre().head<2>(), most = least;
  for (const WheelRig* rig : rigs) {
    if (!rig->has_suspension())
      throw InputError(options.where("rigs"), "has a rig without suspension",
                       "rigs with suspension_stiffness", "the springs of the rigs carry the body");
    if (rig->joined())
      throw InputError(options.where("rigs"), "has a rig that carries a chassis already",
                       "each rig once");
    mass += rig->sprung_mass();
    least = least.cwiseMin(rig->wheel().centre().head<2>());
    most = most.cwiseMax(rig->wheel().centre().head<2>());
  }
  const Vector2 span = most - least, centre = centre_of_mass(rigs);
  const Vector3 inertia(mass, inertia_of(options, "roll_inertia", span.y(), "y"),
                        inertia_of(options, "pitch_inertia", span.x(), "x"));
  Matrix3 support = Matrix3::Zero();
  for (const WheelRig* rig : rigs) {
    const Vector2 arm = (rig->wheel().centre().head<2>() - centre) / span.maxCoeff();
    const Vector3 b(1.0, inertia[1] > 0.0 ? arm.y() : 0.0, inertia[2] > 0.0 ? -arm.x() : 0.0);
    support += rig->strut().stiffness * b * b.transpose();
  }
  for (int k = 1; k < 3; ++k)
    if (inertia[k] == 0.0) support(k, k) = support(0, 0);
  const Vector3 values = Eigen::SelfAdjointEigenSolver<Matrix3>(support).eigenvalues();
  if (!(values[0] > minimum_support * values[2]))
    throw InputError(options.where("rigs"),
                     "has wheels that do not support the body in roll and "
                     "pitch",
                     "two wheels along x or along y, or more that are not in one line");
  return SprungBody(inertia);
}

Chassis::Chassis(const Options& options, std::vector<WheelRig*> rigs)
    : rigs_(std::move(rigs)),
      height_(options.number("height")),
      guide_height_(options.number("guide_height")),
      body_(make_body(options, rigs_)) {
  double radius = 0.0;
  for (const WheelRig* rig : rigs_) radius = std::max(radius, rig->wheel().nominal_radius());
  for (const char* key : {"height", "guide_height"})
    if (std::abs(options.number(key)) > maximum_radii * radius)
      throw InputError(options.where(key), fmt::format("is {:g} m", options.number(key)),
                       fmt::format("-{0:.3g} to {0:.3g} m, {1:g} radii of the largest wheel",
                                   maximum_radii * radius, maximum_radii),
                       "give m, not cm or mm");
  for (WheelRig* rig : rigs_) {
    places_.push_back(rig->wheel().position(Coordinate::x));
    rig->join();
  }
}

void Chassis::release() {
  for (WheelRig* rig : rigs_) rig->leave();
}

void Chassis::apply(double time, double dt) {
  for (const WheelRig* rig : rigs_)
    if (!rig->lowered(time + 0.5 * dt)) return;
  const Vector2 centre = centre_of_mass(rigs_);
  std::vector<Strut> struts;
  for (const WheelRig* rig : rigs_) {
    struts.push_back(rig->strut());
    struts.back().arm -= centre;
  }
  body_.advance(struts, moment(dt), dt);
  for (std::size_t i = 0; i < rigs_.size(); ++i) rigs_[i]->press(struts[i]);
  if (rigs_.front()->travel_free() && rigs_.front()->stage(time + 0.5 * dt) != RigStage::settle)
    keep_distances(dt);
}

/// Pulls the axles to the mean of their velocities and to their distances at the start. The forces
/// sum to zero.
void Chassis::keep_distances(double dt) {
  double mass = 0.0, velocity = 0.0, shift = 0.0;
  const auto mass_along = [](const WheelHub& wheel) {
    return wheel.total_mass() + wheel.dragged_mass();
  };
  for (std::size_t i = 0; i < rigs_.size(); ++i) {
    const WheelHub& wheel = rigs_[i]->wheel();
    const double own = mass_along(wheel);
    mass += own;
    velocity += own * wheel.rate(Coordinate::x);
    shift += own * (wheel.position(Coordinate::x) - places_[i]);
  }
  for (std::size_t i = 0; i < rigs_.size(); ++i) {
    const WheelHub& wheel = rigs_[i]->wheel();
    const double behind = shift / mass - (wheel.position(Coordinate::x) - places_[i]);
    const double slower = velocity / mass - wheel.rate(Coordinate::x);
    rigs_[i]->pull(mass_along(wheel) / dt * (slower + closed_gap * behind / dt));
  }
}

/// About the centre of mass [N m].
Vector2 Chassis::moment(double dt) {
  Vector2 speed = Vector2::Zero(), guides = Vector2::Zero(), moment = Vector2::Zero();
  Vector3 weight = Vector3::Zero();
  double mass = 0.0;
  for (const WheelRig* rig : rigs_) {
    const WheelHub& wheel = rig->wheel();
    mass += rig->sprung_mass();
    speed += rig->sprung_mass() * wheel.velocity().head<2>();
    weight += rig->sprung_weight();
    guides += Vector2(wheel.constraint(Coordinate::x), wheel.constraint(Coordinate::y));
    const Vector3 axle = wheel.axle();
    const Vector2 level(axle.y(), -axle.x());
    moment -= wheel.constraint(Coordinate::spin) * axle.head<2>() +
              wheel.constraint(Coordinate::camber) * level.normalized();
  }
  speed /= mass;
  const Vector2 inertial = mass / dt * (speed - speed_);
  speed_ = speed;
  guides += inertial;
  const Vector2 level = height_ * (weight.head<2>() - inertial) + guide_height_ * guides;
  return moment + Vector2(-level.y(), level.x());
}

const Outputs<const Chassis>& Chassis::outputs() {
  using C = const Chassis;
  static const Outputs<C> list = {
      {"heave", "m", "rise of the centre of mass since the start",
       [](C& c) { return c.body_.position()[0]; }},
      {"roll", "degrees", "turn about x; positive raises the left side",
       [](C& c) { return degrees(c.body_.position()[1]); }},
      {"pitch", "degrees", "turn about y; positive lowers the front",
       [](C& c) { return degrees(c.body_.position()[2]); }},
      {"kinetic_energy", "J", "of heave, roll and pitch",
       [](C& c) { return c.body_.energy().kinetic; }},
      {"spring_energy", "J", "elastic energy of the suspensions",
       [](C& c) { return c.body_.energy().spring; }},
      {"damping_loss", "J", "energy dissipated by the dampers of the suspensions",
       [](C& c) { return c.body_.energy().damping_loss; }},
      {"weight_work", "J", "work of the weight of the body",
       [](C& c) { return c.body_.energy().weight_work; }},
      {"axle_work", "J", "work of the motion of the axles on the suspensions",
       [](C& c) { return c.body_.energy().axle_work; }},
      {"moment_work", "J", "work of horizontal forces and constraint moments of the wheels",
       [](C& c) { return c.body_.energy().moment_work; }},
  };
  return list;
}

void Chassis::checkpoint(Checkpoint& state) {
  body_.checkpoint(state);
  state.values("speed", speed_);
  if (rigs_.front()->travel_free()) state.values("places", places_);
}

}  // namespace furrow
