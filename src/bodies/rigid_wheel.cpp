// SPDX-License-Identifier: GPL-2.0-or-later
#include "bodies/rigid_wheel.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "bodies/hub_options.h"
#include "geometry/closed_surface.h"
#include "core/error.h"

namespace furrow {

namespace {

RigidWheelParameters parameters_from(const Options& options) {
  RigidWheelParameters wheel;
  wheel.geometry.diameter = options.number("diameter");
  wheel.geometry.width = options.number("width");
  wheel.geometry.shoulder = options.number("shoulder");
  wheel.geometry.segments = static_cast<int>(options.integer("segments"));
  if (options.has("element_size")) wheel.geometry.element_size = options.number("element_size");
  const HubOptions hub = read_hub(options, wheel.geometry.width);
  wheel.mass = hub.inertia.mass;
  wheel.axle_inertia = hub.inertia.axial;
  wheel.diametral_inertia = hub.inertia.diametral;
  wheel.axle_centre = hub.centre;

  Grousers& bars = wheel.geometry.grousers;
  bars.number = static_cast<int>(options.integer("grousers"));
  for (const char* key : {"grouser_height", "grouser_thickness"}) {
    if (bars.number > 0 && !options.has(key))
      throw InputError(options.where(key), "is missing", "a number > 0 [m]",
                       "every grouser needs it");
    if (bars.number == 0 && options.has(key))
      throw InputError(options.where(key), "is given to a wheel without grousers",
                       "only with grousers > 0", "add 'grousers <number>' or remove it");
  }
  if (bars.number > 0) {
    bars.height = options.number("grouser_height");
    bars.thickness = options.number("grouser_thickness");
    bars.angle = radians(options.number("grouser_angle"));
  }
  return wheel;
}

void check(const RigidWheelParameters& wheel, const std::string& where) {
  const auto positive = [&](double value, const char* key, const char* unit) {
    if (!(std::isfinite(value) && value > 0.0))
      throw InputError(fmt::format("{}, keyword '{}'", where, key),
                       fmt::format("is {} {}", value, unit), "a number > 0");
  };
  positive(wheel.mass, "mass", "kg");
  positive(wheel.axle_inertia, "inertia", "kg m^2");
  positive(wheel.diametral_inertia, "inertia_diametral", "kg m^2");
  const double reach = wheel.geometry.radius() + wheel.geometry.grousers.height;
  if (wheel.axle_inertia > wheel.mass * reach * reach)
    throw InputError(where + ", keyword 'inertia'", fmt::format("is {} kg m^2", wheel.axle_inertia),
                     fmt::format("at most {:.6g} kg m^2, with all of the mass at the rim",
                                 wheel.mass * reach * reach),
                     "check inertia, mass and diameter");
  if (2.0 * wheel.diametral_inertia < wheel.axle_inertia)
    throw InputError(where + ", keyword 'inertia_diametral'",
                     fmt::format("is {} kg m^2", wheel.diametral_inertia),
                     fmt::format("at least half of inertia, {} kg m^2", 0.5 * wheel.axle_inertia));
  if (!wheel.axle_centre.allFinite())
    throw InputError(where + ", keyword 'axle'", "is not finite", "three numbers [m]");
}

}  // namespace

Schema RigidWheel::schema(const std::string& subject) {
  Schema schema(subject);
  schema.number("diameter", "m", Range::positive(), "diameter of the tread, without grousers");
  schema.number("width", "m", Range::positive(), "width from side to side");
  schema
      .number("shoulder", "m", Range::non_negative(),
              "radius of the shoulders between tread and sides")
      .by_default(0.0);
  declare_hub(schema);
  schema.integer("segments", Range::closed(12, 5000), "facets around the tread").by_default("64");
  schema
      .number("element_size", "m", Range::positive(),
              "size of the elements across; by default one and a half facets")
      .optional();
  schema.integer("grousers", Range::closed(0, 1000), "number of straight bars across the tread")
      .by_default("0");
  schema.number("grouser_height", "m", Range::positive(), "height of the bars above the tread")
      .optional();
  schema
      .number("grouser_thickness", "m", Range::positive(), "thickness of the bars, square to them")
      .optional();
  schema
      .number("grouser_angle", "degrees", Range::closed(-60, 60),
              "skew of the bars against the axle; > 0: the end at +y runs ahead")
      .by_default(0.0);
  return schema;
}

RigidWheel::RigidWheel(const Options& options)
    : RigidWheel(parameters_from(options), options.subject()) {}

RigidWheel::RigidWheel(const RigidWheelParameters& parameters, const std::string& where)
    : WheelHub({parameters.mass, parameters.axle_inertia, parameters.diametral_inertia},
               parameters.axle_centre, "rigid wheel"),
      parameters_(parameters) {
  check(parameters, where);
  surface_ = make_wheel_mesh(parameters.geometry, where);
  check_closed(surface_, where);
  reference_ = surface_.x;
  place_nodes();
}

double RigidWheel::lowest_point() const {
  return centre().z() - parameters_.geometry.depth_below_centre(axle());
}

double RigidWheel::stable_time_step() const { return std::numeric_limits<double>::infinity(); }

void RigidWheel::advance(double dt) {
  advance_hub(dt, surface_.total_force(), surface_.total_moment(centre()));
  place_nodes();
  surface_.check_finite("rigid wheel");
}

void RigidWheel::place_nodes() {
  const Matrix3 turned = attitude();
  for (Eigen::Index node = 0; node < reference_.cols(); ++node) {
    const Vector3 arm = turned * reference_.col(node);
    surface_.x.col(node) = centre() + arm;
    surface_.v.col(node) = velocity() + angular_velocity().cross(arm);
  }
}

EnergyBudget RigidWheel::energy_budget() const {
  EnergyBudget budget = hub_budget();
  budget.contact_work = given_work();
  return budget;
}

void RigidWheel::checkpoint(Checkpoint& state) {
  const WheelGeometry& shape = parameters_.geometry;
  state.match("diameter", shape.diameter);
  state.match("width", shape.width);
  state.match("shoulder", shape.shoulder);
  state.match("grousers", shape.grousers.number);
  state.match("grouser_height", shape.grousers.height);
  state.match("grouser_thickness", shape.grousers.thickness);
  state.match("grouser_angle", shape.grousers.angle);
  state.match("mass", parameters_.mass);
  state.match("inertia", parameters_.axle_inertia);
  state.match("inertia_diametral", parameters_.diametral_inertia);
  state.match("nodes", surface_.node_count());
  checkpoint_hub(state);
  state.values("nodal_force", surface_.f);
  if (!state.saving()) place_nodes();
}

}  // namespace furrow
