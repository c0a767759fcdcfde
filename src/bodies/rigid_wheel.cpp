// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/bodies/rigid_wheel.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/geometry/closed_surface.h"
#include "furrow/geometry/meshes/wheel_mesh.h"

namespace furrow {

namespace {

constexpr double min_gyration = 0.01;  // radius of gyration over radius, of any wheel

Grousers grousers_from(const Options& options) {
  Grousers bars;
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
  return bars;
}

RigidWheelParameters parameters_from(const Options& options) {
  RigidWheelParameters wheel;
  wheel.geometry.diameter = options.number("diameter");
  wheel.geometry.width = options.number("width");
  wheel.geometry.shoulder = options.number("shoulder");
  wheel.geometry.segments = static_cast<int>(options.integer("segments"));
  if (options.has("element_size")) wheel.geometry.element_size = options.number("element_size");
  wheel.geometry.grousers = grousers_from(options);
  wheel.hub = read_hub(options, wheel.geometry.width);
  return wheel;
}

void check(const RigidWheelParameters& wheel, const std::string& where) {
  check(wheel.hub, where);
  const HubInertia& inertia = wheel.hub.inertia;
  const double reach = wheel.geometry.radius() + wheel.geometry.grousers.height;
  if (inertia.axial > inertia.mass * reach * reach)
    throw InputError(where + ", keyword 'inertia'", fmt::format("is {} kg m^2", inertia.axial),
                     fmt::format("at most {:.6g} kg m^2, with all of the mass at the rim",
                                 inertia.mass * reach * reach),
                     "check inertia, mass and diameter");
  const double least = inertia.mass * std::pow(min_gyration * wheel.geometry.radius(), 2);
  if (inertia.axial < least)
    throw InputError(where + ", keyword 'inertia'", fmt::format("is {:g} kg m^2", inertia.axial),
                     fmt::format("at least {:.3g} kg m^2, with a radius of gyration of {:g} of the "
                                 "wheel's",
                                 least, min_gyration),
                     "check inertia, mass and diameter");
}

}  // namespace

Schema RigidWheel::schema(const std::string& subject) {
  Schema schema(subject);
  schema.number("diameter", "m", Range::positive(), "diameter of the tread, without grousers");
  schema.number("width", "m", Range::positive(), "width from side to side");
  schema
      .number("shoulder", "m", Range::non_negative(),
              "radius of the shoulders, at most half the width; 0: a sharp edge")
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
      .number("grouser_thickness", "m", Range::positive(), "thickness of the bars, normal to them")
      .optional();
  schema
      .number("grouser_angle", "degrees", Range::closed(-60, 60),
              "skew of the bars from the axle; positive: the end at +y leads")
      .by_default(0.0);
  return schema;
}

RigidWheel::RigidWheel(const Options& options)
    : RigidWheel(parameters_from(options), options.subject()) {}

RigidWheel::RigidWheel(const RigidWheelParameters& parameters, const std::string& where)
    : RigidWheel(parameters, make_wheel_mesh(parameters.geometry, where), where) {}

RigidWheel::RigidWheel(const RigidWheelParameters& parameters, Surface surface,
                       const std::string& where)
    : WheelHub(parameters.hub, "rigid wheel"),
      parameters_(parameters),
      surface_(std::move(surface)) {
  check(parameters, where);
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
  const Matrix3 rotation = attitude();
  for (Eigen::Index node = 0; node < reference_.cols(); ++node) {
    const Vector3 arm = rotation * reference_.col(node);
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
  state.match("mass", parameters_.hub.inertia.mass);
  state.match("inertia", parameters_.hub.inertia.axial);
  state.match("inertia_diametral", parameters_.hub.inertia.diametral);
  state.match("nodes", surface_.node_count());
  checkpoint_hub(state);
  state.values("nodal_force", surface_.f);
  if (!state.saving()) place_nodes();
}

}  // namespace furrow
