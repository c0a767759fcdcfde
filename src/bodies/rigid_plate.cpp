// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/bodies/rigid_plate.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

PlateGeometry geometry_from(const Options& options) {
  const std::string& shape = options.text("shape");
  PlateGeometry plate;
  plate.shape = shape == "circle"    ? PlateShape::circle
                : shape == "square"  ? PlateShape::square
                : shape == "annulus" ? PlateShape::annulus
                                     : PlateShape::cone;
  plate.size = options.number("size");
  plate.thickness = options.number("thickness");
  plate.elements = static_cast<int>(options.integer("elements"));
  plate.inner_size = options.number("inner_size");
  plate.angle = options.number("angle");
  if (options.given("angle") && plate.shape != PlateShape::cone)
    throw InputError(options.where("angle"), fmt::format("is given for a {}", shape),
                     "an apex angle of a cone", "remove it, or write 'shape cone'");
  return plate;
}

Vector3 centre_from(const Options& options) {
  const std::vector<double>& centre = options.numbers("centre");
  return {centre[0], centre[1], centre[2]};
}

}  // namespace

Schema RigidPlate::schema(const std::string& subject) {
  Schema schema(subject);
  schema.choice("shape", {"circle", "square", "annulus", "cone"}, "outline of the plate")
      .by_default("circle");
  schema.number("size", "m", Range::positive(), "outer diameter, or side of a square");
  schema.number("inner_size", "m", Range::non_negative(), "inner diameter of an annulus")
      .by_default(0.0);
  schema.number("angle", "degree", Range::closed(20.0, 120.0), "apex angle of a cone")
      .by_default(30.0);
  schema.number("thickness", "m", Range::positive(),
                "height of the edge, or length of a cone's shaft; more than the sinkage, unless "
                "sand may cover the plate");
  schema.integer("elements", Range::closed(2, 400), "triangles across the plate; even for a circle")
      .by_default("20");
  schema.numbers("centre", 3, "m", Range::any(),
                 "x y z of the centre of the lower face, or of the apex, at the start");
  return schema;
}

RigidPlate::RigidPlate(const Options& options)
    : RigidPlate(geometry_from(options), centre_from(options), options.subject()) {}

RigidPlate::RigidPlate(const PlateGeometry& geometry, const Vector3& centre,
                       const std::string& where)
    : RigidPlate(geometry, make_plate_mesh(geometry, where), centre) {}

RigidPlate::RigidPlate(const PlateGeometry& geometry, Surface surface, const Vector3& centre)
    : geometry_(geometry), surface_(std::move(surface)), reference_(surface_.x), centre_(centre) {
  place_nodes();
}

void RigidPlate::prescribe(const Vector3& velocity, double spin) {
  if (!velocity.allFinite() || !std::isfinite(spin))
    throw StateError(
        fmt::format("rigid plate: prescribed velocity is {}, spin is {}", velocity.sum(), spin));
  velocity_ = velocity;
  spin_ = spin;
}

double RigidPlate::mean_pressure() const { return surface_.total_force().z() / geometry_.area(); }

double RigidPlate::torque() const { return surface_.total_moment(centre_).z(); }

double RigidPlate::stable_time_step() const { return std::numeric_limits<double>::infinity(); }

void RigidPlate::advance(double dt) {
  const Vector3 force = surface_.total_force();
  if (!force.allFinite())
    throw StateError(fmt::format("rigid plate: the force on it is {} N", force.norm()));
  contact_work_ += (force.dot(velocity_) + torque() * spin_) * dt;
  centre_ += velocity_ * dt;
  angle_ += spin_ * dt;
  place_nodes();
}

void RigidPlate::place_nodes() {
  const Matrix3X turned =
      Eigen::AngleAxisd(angle_, Vector3::UnitZ()).toRotationMatrix() * reference_;
  surface_.x = turned.colwise() + centre_;
  surface_.v.row(0) = -spin_ * turned.row(1);
  surface_.v.row(1) = spin_ * turned.row(0);
  surface_.v.row(2).setZero();
  surface_.v.colwise() += velocity_;
}

EnergyBudget RigidPlate::energy_budget() const {
  EnergyBudget budget;
  budget.contact_work = contact_work_;
  budget.drive_work = -contact_work_;
  return budget;
}

void RigidPlate::checkpoint(Checkpoint& state) {
  state.match("shape", static_cast<int>(geometry_.shape));
  state.match("size", geometry_.size);
  state.match("thickness", geometry_.thickness);
  state.match("elements", geometry_.elements);
  state.match("inner_size", geometry_.inner_size);
  state.match("angle", geometry_.angle);
  state.values("centre", centre_);
  state.values("velocity", velocity_);
  state.value("spin", spin_);
  state.value("turned", angle_);
  state.value("contact_work", contact_work_);
  state.values("nodal_force", surface_.f);
  if (!state.saving()) place_nodes();
}

}  // namespace furrow
