// SPDX-License-Identifier: GPL-2.0-or-later
#include "tyre/darnell_tyre.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/check_number.h"
#include "core/error.h"
#include "tyre/sidewall_direct.h"

namespace furrow {

namespace {

// a rim lighter than this share of the tread would be moved by every wave in it
constexpr double min_mass_share = 0.02;
// of a ring, that section_width() looks at: profiles by the chain take time
constexpr std::size_t max_profiles = 72;

std::unique_ptr<Sidewall> make_sidewall(const TyreParameters& tyre, bool direct,
                                        const SidewallTableMaker& make_table) {
  if (direct) return std::make_unique<SidewallDirect>(tyre.sidewall, tyre.pressure);
  SidewallTableGrid grid;  // wrinkles rotate the tread's edge further than a smooth shape does
  grid.rotation_min = radians(-105);
  grid.rotation_max = radians(105);
  grid.rotation_nodes = 21;
  if (make_table) return make_table(tyre.sidewall, tyre.pressure, grid);
  return std::make_unique<SidewallTable>(tyre.sidewall, tyre.pressure, grid);
}

ShellSection tread_section(const TreadParameters& tread) {
  return ShellSection(
      {tread.E1, tread.E2, tread.nu12, tread.G12, tread.G12, tread.G12, tread.thickness},
      tread.areal_mass);
}

Vector3 circumferential(const Vector3& at) { return {-at.z(), 0.0, at.x()}; }

TreadMesh checked_mesh(const TyreParameters& tyre, const DarnellTyreSettings& settings,
                       const HubParameters& hub, const std::string& where) {
  check(tyre, where);
  check(settings, where);
  check(hub, where);
  return make_tread_mesh(tyre.tread, settings.across, settings.around, settings.half);
}

}  // namespace

void check(const DarnellTyreSettings& settings, const std::string& where) {
  check_integer(settings.across, Range::closed(2, 200), where + ", elements across");
  check_integer(settings.around, Range::closed(12, 2000), where + ", elements around");
  if (settings.half && settings.across % 2 != 0)
    throw InputError(where + ", elements across", fmt::format("is {}", settings.across),
                     "an even number for a half model");
  check_integer(settings.sidewall_rows, Range::closed(0, 50), where + ", sidewall rows");
  check_number(settings.damping_rate, Range::non_negative(), where + ", damping rate", "1/s");
}

DarnellTyre::DarnellTyre(const TyreParameters& tyre, const DarnellTyreSettings& settings,
                         const HubParameters& hub, const std::string& where,
                         const SidewallTableMaker& make_table)
    : DarnellTyre(tyre, settings, hub, make_table, checked_mesh(tyre, settings, hub, where)) {}

DarnellTyre::DarnellTyre(const TyreParameters& tyre, const DarnellTyreSettings& settings,
                         const HubParameters& hub, const SidewallTableMaker& make_table,
                         TreadMesh mesh)
    : Tyre(hub, "tyre"),
      tyre_(tyre),
      settings_(settings),
      grid_(mesh.grid),
      copies_(mesh.grid.copies()),
      nodes_(mesh.x.colwise() + hub.centre),
      reference_(mesh.x),
      shell_(mesh.x, mesh.quads, tread_section(tyre.tread), circumferential),
      rings_(make_rings(make_table)),
      surface_(mesh, rings_, settings.sidewall_rows),
      damping_(settings.damping_rate),
      pressure_(tyre.pressure),
      stable_step_(shell_.stable_time_step()),
      contact_(Matrix3X::Zero(3, nodes_.count())) {
  nodes_.mass = shell_.mass();
  nodes_.inertia = shell_.rotary_inertia();
  if (settings.half) hold_symmetry_plane();
  const double band = copies_ * nodes_.mass.sum();
  if (hub.inertia.mass < min_mass_share * band)
    throw InputError("tyre, mass of the rim",
                     fmt::format("is {} kg under a tread of {:.4g} kg", hub.inertia.mass, band),
                     fmt::format("at least {:.3g} kg", min_mass_share * band));
  compute_internal();
  zero_ = potential();
  place_surface();
}

void DarnellTyre::hold_symmetry_plane() {
  for (int i = 0; i < grid_.around; ++i) {
    const int node = grid_.node(i, 0);
    nodes_.free_to_move(1, node) = 0.0;
    nodes_.free_to_turn(0, node) = 0.0;
    nodes_.free_to_turn(2, node) = 0.0;
  }
}

std::vector<SidewallRing> DarnellTyre::make_rings(const SidewallTableMaker& make_table) const {
  const double edge_radius = tyre_.tread.radius - tyre_.tread.crown;
  const double width = 2.0 * pi * edge_radius / grid_.around;
  std::vector<SidewallRing> rings;
  for (const int side : {+1, -1}) {
    if (settings_.half && side < 0) continue;
    std::vector<int> edge;
    for (int i = 0; i < grid_.around; ++i) edge.push_back(grid_.node(i, side > 0 ? grid_.rows : 0));
    rings.emplace_back(make_sidewall(tyre_, settings_.direct, make_table), tyre_, side,
                       std::move(edge), width);
  }
  return rings;
}

double DarnellTyre::lowest_point() const {
  double lowest = 0.0;
  const Vector3 a = axle();
  for (int j = 0; j < grid_.lines(); ++j) {  // lines are circles, those of the other half mirrored
    const Vector3& at = reference_.col(grid_.node(0, j));
    const double radius = std::hypot(at.x(), at.z());
    for (const double side : {1.0, settings_.half ? -1.0 : 1.0}) {
      lowest = std::min(
          lowest, side * at.y() * a.z() - radius * std::sqrt(std::max(0.0, 1.0 - a.z() * a.z())));
    }
  }
  return centre().z() + lowest;
}

double DarnellTyre::total_mass() const {
  return WheelHub::total_mass() + copies_ * nodes_.mass.sum();
}

Wrench DarnellTyre::ground_wrench() const { return of_whole(WheelHub::ground_wrench()); }

/// Adds the mirror image in y = 0 of what acts on a half model.
Wrench DarnellTyre::of_whole(const Wrench& computed) const {
  if (!settings_.half) return computed;
  return {Vector3(2.0 * computed.force.x(), 0.0, 2.0 * computed.force.z()),
          Vector3(0.0, 2.0 * computed.moment.y(), 0.0)};
}

double DarnellTyre::potential() const {
  double sidewalls = 0.0;
  for (const SidewallRing& ring : rings_) sidewalls += ring.potential();
  return copies_ * (shell_.energy() + sidewalls) - pressure_ * volume_;
}

void DarnellTyre::set_pressure(double pressure) {
  compute_internal();
  const double before = potential() - zero_;
  for (SidewallRing& ring : rings_) ring.set_pressure(pressure);
  pressure_ = pressure;
  compute_internal();
  count_stored_energy();
  inflation_work_ += stored_ - before;
}

/// Shell, pressure and sidewalls: sets nodes_.force, nodes_.moment, internal_on_rim_, volume_.
void DarnellTyre::compute_internal() {
  nodes_.force.setZero();
  nodes_.moment.setZero();
  shell_.add_forces(nodes_, pressure_);
  volume_ = shell_.volume();
  const RimPose pose = rim();
  for (SidewallRing& ring : rings_) {
    ring.add_forces(nodes_, pose);
    volume_ += ring.volume();
  }
  volume_ *= copies_;
  internal_on_rim_.force = -nodes_.force.rowwise().sum();
  internal_on_rim_.moment = -nodes_.moment.rowwise().sum();
  for (Eigen::Index n = 0; n < nodes_.count(); ++n)
    internal_on_rim_.moment -=
        Vector3(nodes_.x.col(n) - centre()).cross(Vector3(nodes_.force.col(n)));
  internal_on_rim_ = of_whole(internal_on_rim_);
}

/// Adds the forces on the surface to nodes_.force, and sets contact_ and contact_on_rim_.
void DarnellTyre::compute_contact() {
  contact_on_rim_ = of_whole(surface_.hand_over(nodes_, rings_, *this, contact_));
  nodes_.force += contact_;
}

/// What a deformed tyre is refused for is seldom what is wrong.
void DarnellTyre::advance(double dt) try { step(dt); } catch (const StateError& problem) {
  throw StateError(
      fmt::format("{}; at {:g} Pa it carries a load of {:.4g} N and its axle moves at {:.3g} m/s; "
                  "likely causes: a load that this pressure does not carry, a speed or time step "
                  "that is too large, a start in the ground, a contact too stiff or too damped, a "
                  "rim too light",
                  problem.what(), pressure_, -load().z(), velocity().norm()));
}

void DarnellTyre::step(double dt) {
  compute_internal();
  damping_.add(nodes_, *this);
  Wrench on_rim = of_whole(damping_.reaction(nodes_, centre()));
  on_rim.force = internal_on_rim_.force + on_rim.force;
  on_rim.moment = internal_on_rim_.moment + on_rim.moment;
  compute_contact();
  const Matrix3X v_before = nodes_.v;
  const Matrix3X w_before = nodes_.w;
  const Vector3 V_before = velocity();
  const Vector3 Omega_before = angular_velocity();
  nodes_.kick(dt);
  advance_hub(dt, on_rim.force + contact_on_rim_.force, on_rim.moment + contact_on_rim_.moment);

  const Vector3 V = 0.5 * (V_before + velocity());
  const Vector3 Omega = 0.5 * (Omega_before + angular_velocity());
  contact_work_ += dt * copies_ * (contact_.cwiseProduct(0.5 * (v_before + nodes_.v))).sum();
  contact_work_ += dt * (contact_on_rim_.force.dot(V) + contact_on_rim_.moment.dot(Omega));
  const double power = damping_.power(nodes_, v_before, w_before);
  const Wrench reaction = of_whole(damping_.reaction(nodes_, centre() - dt * velocity()));
  damped_ -= dt * (copies_ * power + reaction.force.dot(V) + reaction.moment.dot(Omega));

  nodes_.drift(dt);
  count_stored_energy();
  place_surface();
  if (!nodes_.x.allFinite()) surface().check_finite("tyre");
}

/// The deformed shape moves along; the stored energy stays.
void DarnellTyre::follow_placement(const Vector3& old_centre, const Matrix3& old_attitude) {
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

void DarnellTyre::follow_velocity() {
  for (Eigen::Index n = 0; n < nodes_.count(); ++n) {
    nodes_.v.col(n) = velocity_at(nodes_.x.col(n));
    nodes_.w.col(n) = angular_velocity();
  }
  place_surface();
}

double DarnellTyre::kinetic_energy() const {
  return hub_energy() + copies_ * nodes_.kinetic_energy();
}

EnergyBudget DarnellTyre::energy_budget() const {
  EnergyBudget budget = hub_budget();
  budget.momentum += of_whole({nodes_.v * nodes_.mass, Vector3::Zero()}).force;
  budget.kinetic_energy = kinetic_energy();
  budget.stored_energy = stored_;
  budget.dissipated_energy += damped_;
  budget.contact_work = contact_work_;
  budget.load_work += inflation_work_;
  return budget;
}

double DarnellTyre::section_width() {
  double widest = 0.0;
  const RimPose pose = rim();
  for (SidewallRing& ring : rings_) {
    const std::size_t every = std::max<std::size_t>(1, ring.stations() / max_profiles);
    for (std::size_t i = 0; i < ring.stations(); i += every) {
      const Matrix3X points = ring.profile(i, nodes_, pose);
      for (Eigen::Index k = 0; k < points.cols(); ++k)
        widest =
            std::max(widest, ring.side() * (points.col(k) - centre()).dot(pose.attitude.col(1)));
    }
  }
  return 2.0 * widest;
}

double DarnellTyre::largest_sidewall_chord() const {
  double largest = 0.0;
  for (const SidewallRing& ring : rings_) largest = std::max(largest, ring.largest_chord());
  return largest;
}

void DarnellTyre::checkpoint(Checkpoint& state) {
  const TreadParameters& tread = tyre_.tread;
  state.match("across", settings_.across);
  state.match("around", settings_.around);
  state.match("half", settings_.half);
  state.match("sidewall_rows", settings_.sidewall_rows);
  state.match("tread_radius", tread.radius);
  state.match("tread_half_width", tread.half_width);
  state.match("tread_thickness", tread.thickness);
  state.match("E1", tread.E1);
  state.match("E2", tread.E2);
  state.match("sidewall_length", tyre_.sidewall.length);
  checkpoint_hub(state);
  nodes_.checkpoint(state);
  double pressure = pressure_;
  state.value("pressure", pressure);
  if (pressure != pressure_) {
    for (SidewallRing& ring : rings_) ring.set_pressure(pressure);
    pressure_ = pressure;
  }
  state.value("zero_of_energy", zero_);
  state.value("stored", stored_);
  state.value("contact_work", contact_work_);
  state.value("inflation_work", inflation_work_);
  state.value("damped", damped_);
  state.values("nodal_force", surface().f);
  if (!state.saving()) place_surface();
}

}  // namespace furrow
