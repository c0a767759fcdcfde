// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/nodal_tyre.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

// a rim lighter than this share of the tread would be moved by every wave in it
constexpr double min_mass_share = 0.02;
// [kg], [kg m^2] of a bead, which moves as the rim does: none, but one that may be divided by
constexpr double no_mass = 1e-30;

}  // namespace

NodalTyre::NodalTyre(const HubParameters& hub, const Making& making)
    : Tyre(hub, "tyre"),
      nodes_(making.reference.colwise() + hub.centre),
      reference_(making.reference),
      pressure_(making.pressure),
      node_step_(making.damping_rate),
      contact_(Matrix3X::Zero(3, nodes_.count())) {}

void NodalTyre::start() {
  for (const Eigen::Index bead : beads_) nodes_.mass[bead] = nodes_.inertia[bead] = no_mass;
  const double band = copies() * nodes_.mass.sum();
  const double rim = WheelHub::total_mass();
  if (rim < min_mass_share * band)
    throw InputError("tyre, mass of the rim",
                     fmt::format("is {} kg under a tread of {:.4g} kg", rim, band),
                     fmt::format("at least {:.3g} kg", min_mass_share * band));
  node_step_.take_supports(nodes_);
  compute_internal();
  zero_ = potential();
  place_surface();
}

void NodalTyre::hold_in_symmetry_plane(Eigen::Index node) {
  nodes_.free_to_move(1, node) = 0.0;
  nodes_.free_to_turn(0, node) = 0.0;
  nodes_.free_to_turn(2, node) = 0.0;
}

void NodalTyre::carry_by_rim(Eigen::Index node) {
  nodes_.hold(node);
  beads_.push_back(node);
}

void NodalTyre::place_beads() {
  if (beads_.empty()) return;
  const Matrix3 R = attitude();
  const Quaternion q(R);
  for (const Eigen::Index bead : beads_) {
    nodes_.x.col(bead) = centre() + R * reference_.col(bead);
    nodes_.v.col(bead) = velocity_at(nodes_.x.col(bead));
    nodes_.w.col(bead) = angular_velocity();
    nodes_.set_rotation(bead, q);
  }
}

double NodalTyre::lowest_point() const {
  const TreadGrid& grid = tread_grid();
  double lowest = 0.0;
  const Vector3 a = axle();
  for (int j = 0; j < grid.lines(); ++j) {  // lines are circles, those of the other half mirrored
    const Vector3 at = unloaded_tread_point(j);
    const double radius = std::hypot(at.x(), at.z());
    for (const double side : {1.0, grid.half ? -1.0 : 1.0}) {
      lowest = std::min(
          lowest, side * at.y() * a.z() - radius * std::sqrt(std::max(0.0, 1.0 - a.z() * a.z())));
    }
  }
  return centre().z() + lowest;
}

double NodalTyre::total_mass() const {
  return WheelHub::total_mass() + copies() * nodes_.mass.sum();
}

Wrench NodalTyre::ground_wrench() const { return to_whole(WheelHub::ground_wrench()); }

/// Adds the mirror image in y = 0 of what acts on a half model.
Wrench NodalTyre::to_whole(const Wrench& computed) const {
  if (!half_model()) return computed;
  return {Vector3(2.0 * computed.force.x(), 0.0, 2.0 * computed.force.z()),
          Vector3(0.0, 2.0 * computed.moment.y(), 0.0)};
}

void NodalTyre::set_pressure(double pressure) {
  compute_internal();
  const double before = potential() - zero_;
  pressure_ = pressure;
  follow_pressure();
  compute_internal();
  count_stored_energy();
  inflation_work_ += stored_ - before;
}

/// Elements and pressure: sets nodes_.force, nodes_.moment, elastic_, volume_.
void NodalTyre::compute_internal() {
  nodes_.force.setZero();
  nodes_.moment.setZero();
  const Internal internal = add_internal_forces();
  elastic_ = copies() * internal.energy;
  volume_ = copies() * internal.volume;
}

/// Forces on the surface: sets contact_ and contact_on_rim_.
void NodalTyre::compute_contact() { contact_on_rim_ = to_whole(hand_over(contact_)); }

/// Wrench of elements and pressure on the rim of the whole tyre: the opposite of their sum on the
/// nodes, and their action on the beads.
Wrench NodalTyre::internal_on_rim() const {
  Wrench on_rim = internal_on_beads();
  on_rim.force -= nodes_.force.rowwise().sum();
  on_rim.moment -= nodes_.moment.rowwise().sum();
  for (Eigen::Index n = 0; n < nodes_.count(); ++n)
    on_rim.moment -= Vector3(nodes_.x.col(n) - centre()).cross(Vector3(nodes_.force.col(n)));
  return to_whole(on_rim);
}

/// Wrench of elements and pressure on the beads of the computed part.
Wrench NodalTyre::internal_on_beads() const {
  Wrench on_beads;
  for (const Eigen::Index n : beads_) {
    on_beads.force += nodes_.force.col(n);
    on_beads.moment += Vector3(nodes_.moment.col(n)) +
                       Vector3(nodes_.x.col(n) - centre()).cross(Vector3(nodes_.force.col(n)));
  }
  return on_beads;
}

void NodalTyre::begin_interval(bool touched) {
  WheelHub::begin_interval(touched);
  surface_follows_ = touched;
}

void NodalTyre::end_interval() {
  WheelHub::end_interval();
  if (!surface_follows_) place_surface();
  surface_follows_ = true;
}

/// Adds likely causes to an error: the symptom in a deformed tyre is seldom the cause.
void NodalTyre::advance(double dt) try { step(dt); } catch (const StateError& problem) {
  throw StateError(
      fmt::format("{}; at {:g} Pa it carries a load of {:.4g} N and its axle moves at {:.3g} m/s; "
                  "likely causes: a load that this pressure does not carry, a speed or time step "
                  "that is too large, a start in the ground, a contact too stiff or too damped, a "
                  "rim too light",
                  problem.what(), pressure_, -load().z(), velocity().norm()));
}

void NodalTyre::step(double dt) {
  compute_internal();
  compute_contact();
  const Wrench on_beads = internal_on_beads();
  const NodeStep::Sums sums = node_step_.move(nodes_, contact_, *this, dt);
  const Wrench damping = to_whole({Vector3(-sums.damping.force), Vector3(-sums.damping.moment)});
  const Wrench internal = to_whole({Vector3(on_beads.force - sums.internal.force),
                                    Vector3(on_beads.moment - sums.internal.moment)});
  const Vector3 V_before = velocity();
  const Vector3 Omega_before = angular_velocity();
  advance_hub(dt, internal.force + damping.force + contact_on_rim_.force,
              internal.moment + damping.moment + contact_on_rim_.moment);

  const Vector3 V = 0.5 * (V_before + velocity());
  const Vector3 Omega = 0.5 * (Omega_before + angular_velocity());
  contact_work_ += dt * (copies() * sums.contact_power + contact_on_rim_.force.dot(V) +
                         contact_on_rim_.moment.dot(Omega));
  damped_ -=
      dt * (copies() * sums.damping_power + damping.force.dot(V) + damping.moment.dot(Omega));

  place_beads();
  count_stored_energy();
  if (surface_follows_ || !sums.finite) place_surface();
  if (!sums.finite) surface().check_finite("tyre");
}

/// The deformed shape follows; the stored energy stays.
void NodalTyre::follow_placement(const Vector3& old_centre, const Matrix3& old_attitude) {
  const Matrix3 rotation = attitude() * old_attitude.transpose();
  const Quaternion q(rotation);
  nodes_.x = (rotation * (nodes_.x.colwise() - old_centre)).colwise() + centre();
  nodes_.stop();
  for (Eigen::Index n = 0; n < nodes_.count(); ++n)
    nodes_.set_rotation(n, (q * nodes_.q[static_cast<std::size_t>(n)]).normalized());
  compute_internal();
  zero_ = potential() - stored_;
  place_surface();
}

void NodalTyre::follow_velocity() {
  for (Eigen::Index n = 0; n < nodes_.count(); ++n) {
    nodes_.v.col(n) = velocity_at(nodes_.x.col(n));
    nodes_.w.col(n) = angular_velocity();
  }
  place_surface();
}

double NodalTyre::kinetic_energy() const {
  return hub_energy() + copies() * nodes_.kinetic_energy();
}

EnergyBudget NodalTyre::energy_budget() const {
  EnergyBudget budget = hub_budget();
  budget.momentum += to_whole({nodes_.v * nodes_.mass, Vector3::Zero()}).force;
  budget.kinetic_energy = kinetic_energy();
  budget.stored_energy = stored_;
  budget.dissipated_energy += damped_;
  budget.contact_work = contact_work_;
  budget.load_work += inflation_work_;
  return budget;
}

void NodalTyre::checkpoint_nodes(Checkpoint& state) {
  checkpoint_hub(state);
  nodes_.checkpoint(state);
  const double before = pressure_;
  state.value("pressure", pressure_);
  if (pressure_ != before) follow_pressure();
  state.value("zero_of_energy", zero_);
  state.value("stored", stored_);
  state.value("contact_work", contact_work_);
  state.value("inflation_work", inflation_work_);
  state.value("damped", damped_);
  state.values("nodal_force", surface().f);
  if (!state.saving()) place_surface();
}

}  // namespace furrow
