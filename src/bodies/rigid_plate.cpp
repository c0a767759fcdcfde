// SPDX-License-Identifier: GPL-2.0-or-later
#include "bodies/rigid_plate.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/error.h"

namespace furrow {

namespace {

PlateGeometry geometry_from(const Options& options) {
  PlateGeometry plate;
  plate.shape = options.text("shape") == "circle" ? PlateShape::circle : PlateShape::square;
  plate.size = options.number("size");
  plate.thickness = options.number("thickness");
  plate.elements = static_cast<int>(options.integer("elements"));
  return plate;
}

Vector3 centre_from(const Options& options) {
  const std::vector<double>& centre = options.numbers("centre");
  return {centre[0], centre[1], centre[2]};
}

}  // namespace

Schema RigidPlate::schema(const std::string& subject) {
  Schema schema(subject);
  schema.choice("shape", {"circle", "square"}, "outline of the plate").by_default("circle");
  schema.number("size", "m", Range::positive(), "diameter of a circle, side of a square");
  schema.number("thickness", "m", Range::positive(),
                "height of the edge; more than the sinkage, unless sand may cover the plate");
  schema.integer("elements", Range::closed(2, 400), "triangles across the plate; even for a circle")
      .by_default("20");
  schema.numbers("centre", 3, "m", Range::any(),
                 "x y z of the centre of the lower face at the start");
  return schema;
}

RigidPlate::RigidPlate(const Options& options)
    : RigidPlate(geometry_from(options), centre_from(options), options.subject()) {}

RigidPlate::RigidPlate(const PlateGeometry& geometry, const Vector3& centre,
                       const std::string& where)
    : geometry_(geometry), surface_(make_plate_mesh(geometry, where)), centre_(centre) {
  reference_ = surface_.x;
  place_nodes();
}

void RigidPlate::prescribe(double velocity) {
  if (!std::isfinite(velocity))
    throw StateError(fmt::format("rigid plate: prescribed velocity is {}", velocity));
  velocity_ = velocity;
}

double RigidPlate::mean_pressure() const { return surface_.total_force().z() / geometry_.area(); }

double RigidPlate::stable_time_step() const { return std::numeric_limits<double>::infinity(); }

void RigidPlate::advance(double dt) {
  const double force = surface_.total_force().z();
  if (!std::isfinite(force))
    throw StateError(fmt::format("rigid plate: the force on it is {} N", force));
  contact_work_ += force * velocity_ * dt;
  centre_.z() += velocity_ * dt;
  place_nodes();
}

void RigidPlate::place_nodes() {
  surface_.x = reference_.colwise() + centre_;
  surface_.v.colwise() = Vector3(0.0, 0.0, velocity_);
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
  state.values("centre", centre_);
  state.value("velocity", velocity_);
  state.value("contact_work", contact_work_);
  state.values("nodal_force", surface_.f);
  if (!state.saving()) place_nodes();
}

}  // namespace furrow
