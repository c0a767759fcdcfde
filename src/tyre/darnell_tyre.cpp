// SPDX-License-Identifier: GPL-2.0-or-later
#include "tyre/darnell_tyre.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <fmt/format.h>

#include "core/error.h"

#include "tyre/sidewall_direct.h"

namespace furrow {

namespace {

// a rim lighter than this share of the tread would be moved by every wave in it
constexpr double min_mass_share = 0.02;
// The first part of a relaxation (DarnellTyre::settle).
constexpr double approach_time = 0.12;         // [s]
constexpr double approach_damping = 2000.0;    // [1/s] of the tread
constexpr double approach_rim_damping = 60.0;  // [1/s]
// [1/s] of the tread afterwards: wrinkles that snap must not swing
constexpr double wrinkle_damping = 200.0;
// [m/s] at the start, so that no unstable even shape is taken for rest
constexpr double disturbance = 1e-3;

/// From 0 at 0 to 1 at 1 with continuous second derivative.
double smooth_step(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * u * (10.0 - u * (15.0 - 6.0 * u));
}

std::unique_ptr<Sidewall> make_sidewall(const TyreParameters& tyre, bool direct,
                                        const SidewallTableMaker& make_table) {
  if (direct) return std::make_unique<SidewallDirect>(tyre.sidewall, tyre.pressure);
  SidewallTableGrid grid;  // wrinkles turn the tread's edge further than a smooth shape does
  grid.rotation_min = radians(-105);
  grid.rotation_max = radians(105);
  grid.rotation_nodes = 21;
  if (make_table) return make_table(tyre.sidewall, tyre.pressure, grid);
  return std::make_unique<SidewallTable>(tyre.sidewall, tyre.pressure, grid);
}

OrthotropicLayer tread_layer(const TreadParameters& tread) {
  return {tread.E1, tread.E2, tread.nu12, tread.G12, tread.G12, tread.G12, tread.thickness};
}

}  // namespace

/// Tread nodes about the axle centre, and their quadrilaterals.
struct DarnellTyre::Mesh {
  Matrix3X x;
  std::vector<Shell4::Quad> quads;
  int rows;

  Mesh(const TyreParameters& tyre, const DarnellTyreSettings& settings, const std::string& where) {
    check(tyre, where);
    const auto need = [&](bool good, const char* name, int value, const char* allowed) {
      if (!good)
        throw InputError(fmt::format("{}, {}", where, name), fmt::format("is {}", value), allowed);
    };
    need(settings.across >= 2 && settings.across <= 200, "elements across", settings.across,
         "2 to 200");
    need(settings.around >= 12 && settings.around <= 2000, "elements around", settings.around,
         "12 to 2000");
    need(!settings.half || settings.across % 2 == 0, "elements across", settings.across,
         "an even number for a half model");
    need(settings.sidewall_points >= 0 && settings.sidewall_points <= 50, "sidewall points",
         settings.sidewall_points, "0 to 50");
    if (!(std::isfinite(settings.damping_rate) && settings.damping_rate >= 0.0))
      throw InputError(where + ", damping rate", fmt::format("is {} 1/s", settings.damping_rate),
                       "a number >= 0");
    rows = settings.half ? settings.across / 2 : settings.across;
    const TreadParameters& tread = tyre.tread;
    x.resize(3, settings.around * (rows + 1));
    const auto node = [&](int i, int j) { return (i % settings.around) * (rows + 1) + j; };
    for (int i = 0; i < settings.around; ++i)
      for (int j = 0; j <= rows; ++j) {
        const double across = settings.half ? double(j) / rows : 2.0 * j / rows - 1.0;
        const double angle = 2.0 * pi * i / settings.around,
                     radius = tread.radius - tread.crown * across * across;
        x.col(node(i, j)) << radius * std::sin(angle), tread.half_width * across,
            -radius * std::cos(angle);
        if (j < rows)
          quads.push_back({node(i, j), node(i, j + 1), node(i + 1, j + 1), node(i + 1, j)});
      }
  }
};

DarnellTyre::DarnellTyre(const TyreParameters& tyre, const DarnellTyreSettings& settings,
                         const DarnellTyreHub& hub, const std::string& where,
                         const SidewallTableMaker& make_table)
    : DarnellTyre(tyre, settings, hub, make_table, Mesh(tyre, settings, where)) {}

DarnellTyre::DarnellTyre(const TyreParameters& tyre, const DarnellTyreSettings& settings,
                         const DarnellTyreHub& hub, const SidewallTableMaker& make_table, Mesh mesh)
    : WheelHub(hub.inertia, hub.centre, "tyre"),
      tyre_(tyre),
      settings_(settings),
      rows_(mesh.rows),
      share_(settings.half ? 2.0 : 1.0),
      nodes_(mesh.x.colwise() + hub.centre),
      reference_(mesh.x),
      shell_(mesh.x, mesh.quads, ShellSection(tread_layer(tyre.tread), tyre.tread.areal_mass),
             [](const Vector3& at) { return Vector3(-at.z(), 0.0, at.x()); }),
      pressure_(tyre.pressure) {
  nodes_.mass = shell_.mass();
  nodes_.inertia = shell_.rotary_inertia();
  if (settings.half)
    for (int i = 0; i < settings.around; ++i) {
      nodes_.free_to_move(1, tread_node(i, 0)) = 0.0;
      nodes_.free_to_turn(0, tread_node(i, 0)) = nodes_.free_to_turn(2, tread_node(i, 0)) = 0.0;
    }
  const auto positive = [](double value, const char* name, const char* unit) {
    if (!(std::isfinite(value) && value > 0.0))
      throw InputError(fmt::format("tyre, {}", name), fmt::format("is {} {}", value, unit),
                       "a number > 0");
  };
  positive(hub.inertia.mass, "mass of the rim", "kg");
  positive(hub.inertia.axial, "inertia of the rim", "kg m^2");
  positive(hub.inertia.diametral, "diametral inertia of the rim", "kg m^2");
  const double band = share_ * nodes_.mass.sum();
  if (hub.inertia.mass < min_mass_share * band)
    throw InputError("tyre, mass of the rim",
                     fmt::format("is {} kg under a tread of {:.4g} kg", hub.inertia.mass, band),
                     fmt::format("at least {:.3g} kg", min_mass_share * band));

  const double edge_radius = tyre.tread.radius - tyre.tread.crown,
               width = 2.0 * pi * edge_radius / settings.around;
  for (const int side : {+1, -1}) {
    if (settings.half && side < 0) continue;
    std::vector<int> edge;
    for (int i = 0; i < settings.around; ++i) edge.push_back(tread_node(i, side > 0 ? rows_ : 0));
    rings_.emplace_back(make_sidewall(tyre, settings.direct, make_table), tyre, side,
                        std::move(edge), width);
  }

  // Surface: the tread's nodes, then rows of sidewall nodes, one ring after the other; triangles
  // outward.
  const int n = settings.around, points = settings.sidewall_points,
            tread_nodes = static_cast<int>(nodes_.count());
  surface_.resize(
      static_cast<std::size_t>(tread_nodes + static_cast<int>(rings_.size()) * n * points));
  const auto add_quad = [&](int a, int b, int c, int d, bool other_diagonal) {
    if (other_diagonal) {
      surface_.triangles.emplace_back(a, b, d);
      surface_.triangles.emplace_back(b, c, d);
    } else {
      surface_.triangles.emplace_back(a, b, c);
      surface_.triangles.emplace_back(a, c, d);
    }
  };
  for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
    const Shell4::Quad& q = mesh.quads[e];
    add_quad(q[0], q[1], q[2], q[3],
             // mirrored about the middle
             settings.half || 2 * (static_cast<int>(e) % rows_) >= rows_);
  }
  for (std::size_t r = 0; r < rings_.size() && points > 0; ++r) {
    const int first = tread_nodes + static_cast<int>(r) * n * points;
    const auto node = [&](int i, int k) {
      i %= n;
      return k == points ? rings_[r].edge()[static_cast<std::size_t>(i)] : first + i * points + k;
    };
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < points; ++k) {
        if (rings_[r].side() > 0)
          add_quad(node(i, k), node(i + 1, k), node(i + 1, k + 1), node(i, k + 1), false);
        else
          add_quad(node(i, k), node(i, k + 1), node(i + 1, k + 1), node(i + 1, k), false);
      }
  }
  damping_force_ = damping_moment_ = contact_ = Matrix3X::Zero(3, nodes_.count());
  force_scale_ = std::max(pressure_, 1e3) * 2.0 * pi * tyre.tread.radius * 2.0 *
                 tyre.tread.half_width / share_ / static_cast<double>(nodes_.count());
  stable_step_ = shell_.stable_time_step();
  compute_internal();
  zero_ = potential();
  stored_ = 0.0;
  place_surface();
}

int DarnellTyre::tread_node(int i, int j) const {
  const int n = settings_.around;
  return ((i % n + n) % n) * (rows_ + 1) + j;
}

double DarnellTyre::lowest_point() const {
  double lowest = 0.0;
  const Vector3 a = axle();
  for (Eigen::Index n = 0; n <= rows_; ++n) {  // rows of circles, those of the other half mirrored
    const Vector3& at = reference_.col(n);
    const double radius = std::hypot(at.x(), at.z());
    for (const double side : {1.0, settings_.half ? -1.0 : 1.0}) {
      lowest = std::min(
          lowest, side * at.y() * a.z() - radius * std::sqrt(std::max(0.0, 1.0 - a.z() * a.z())));
    }
  }
  return centre().z() + lowest;
}

double DarnellTyre::total_mass() const {
  return WheelHub::total_mass() + share_ * nodes_.mass.sum();
}

WheelHub::Wrench DarnellTyre::ground_wrench() const {
  Wrench wrench = WheelHub::ground_wrench();
  mirror(wrench.force, wrench.moment);
  return wrench;
}

double DarnellTyre::potential() const {
  double sidewalls = 0.0;
  for (const SidewallRing& ring : rings_) sidewalls += ring.potential();
  return share_ * (shell_.energy() + sidewalls) - pressure_ * volume_;
}

void DarnellTyre::set_pressure(double pressure) {
  compute_internal();
  const double before = potential() - zero_;
  for (SidewallRing& ring : rings_) ring.set_pressure(pressure);
  pressure_ = pressure;
  compute_internal();
  stored_ = potential() - zero_;
  inflation_work_ += stored_ - before;
}

void DarnellTyre::mirror(Vector3& force, Vector3& moment) const {
  if (!settings_.half) return;
  force = Vector3(2.0 * force.x(), 0.0, 2.0 * force.z());
  moment = Vector3(0.0, 2.0 * moment.y(), 0.0);
}

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
  volume_ *= share_;
  rim_force_ = -nodes_.force.rowwise().sum();
  rim_moment_ = -nodes_.moment.rowwise().sum();
  for (Eigen::Index n = 0; n < nodes_.count(); ++n)
    rim_moment_ -= Vector3(nodes_.x.col(n) - centre()).cross(Vector3(nodes_.force.col(n)));
  mirror(rim_force_, rim_moment_);
}

void DarnellTyre::add_damping() {
  const double c = settings_.damping_rate;
  Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
  for (Eigen::Index n = 0; n < nodes_.count(); ++n) {
    const Vector3 at = nodes_.x.col(n), v = nodes_.v.col(n), w = nodes_.w.col(n);
    const Vector3 f = -c * nodes_.mass[n] * (v - rigid_velocity(at)),
                  m = -c * nodes_.inertia[n] * (w - angular_velocity());
    damping_force_.col(n) = f;
    damping_moment_.col(n) = m;
    force -= f;
    moment -= m + (at - centre()).cross(f);
  }
  nodes_.force += damping_force_;
  nodes_.moment += damping_moment_;
  mirror(force, moment);
  rim_force_ += force;
  rim_moment_ += moment;
}

void DarnellTyre::add_contact() {
  const Eigen::Index n = nodes_.count();
  contact_ = surface_.f.leftCols(n);
  contact_on_rim_.setZero();
  contact_moment_.setZero();
  const int points = settings_.sidewall_points;
  Eigen::Index node = n;
  for (const SidewallRing& ring : rings_)
    for (std::size_t i = 0; i < ring.stations(); ++i)
      for (int k = 0; k < points; ++k, ++node) {
        const Vector3 f = surface_.f.col(node);
        if (f.isZero(0.0)) continue;
        const double s = static_cast<double>(k) / points;
        const Eigen::Index edge = ring.edge()[i];
        contact_.col(edge) += s * f;
        contact_on_rim_ += (1.0 - s) * f;
        contact_moment_ +=
            Vector3(surface_.x.col(node) - centre() - s * (nodes_.x.col(edge) - centre())).cross(f);
      }
  nodes_.force += contact_;
  mirror(contact_on_rim_, contact_moment_);
}

void DarnellTyre::advance(double dt) {
  compute_internal();
  add_damping();
  add_contact();
  const Matrix3X v_before = nodes_.v, w_before = nodes_.w;
  const Vector3 V_before = velocity(), Omega_before = angular_velocity();
  nodes_.kick(dt);
  advance_hub(dt, rim_force_ + contact_on_rim_, rim_moment_ + contact_moment_);
  const Vector3 V = 0.5 * (V_before + velocity()),
                Omega = 0.5 * (Omega_before + angular_velocity());

  // Damping: its power on the tread and on the rim, which has the opposite sum of forces and
  // moments.
  Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
  double power = 0.0;
  const Vector3 old_centre = centre() - dt * velocity();
  for (Eigen::Index n = 0; n < nodes_.count(); ++n) {
    const Vector3 f = damping_force_.col(n), m = damping_moment_.col(n);
    power += f.dot(0.5 * (v_before.col(n) + nodes_.v.col(n))) +
             m.dot(0.5 * (w_before.col(n) + nodes_.w.col(n)));
    force -= f;
    moment -= m + Vector3(nodes_.x.col(n) - old_centre).cross(f);
  }
  contact_work_ += dt * share_ * (contact_.cwiseProduct(0.5 * (v_before + nodes_.v))).sum();
  contact_work_ += dt * (contact_on_rim_.dot(V) + contact_moment_.dot(Omega));
  mirror(force, moment);
  damped_ -= dt * (share_ * power + force.dot(V) + moment.dot(Omega));

  nodes_.drift(dt);
  stored_ = potential() - zero_;
  place_surface();
  if (!nodes_.x.allFinite()) surface_.check_finite("tyre");
}

void DarnellTyre::place_surface() {
  const Eigen::Index n = nodes_.count();
  surface_.x.leftCols(n) = nodes_.x;
  surface_.v.leftCols(n) = nodes_.v;
  const int points = settings_.sidewall_points;
  if (points == 0) return;
  const RimPose pose = rim();
  Eigen::Index node = n;
  for (const SidewallRing& ring : rings_) {
    ring.arcs(points, nodes_, pose, surface_.x, node);
    for (std::size_t i = 0; i < ring.stations(); ++i)
      for (int k = 0; k < points; ++k, ++node) {
        const double s = static_cast<double>(k) / points;
        const Eigen::Index edge = ring.edge()[i];
        const Vector3 arm = surface_.x.col(node) - centre() - s * (nodes_.x.col(edge) - centre());
        surface_.v.col(node) =
            s * nodes_.v.col(edge) + (1.0 - s) * velocity() + angular_velocity().cross(arm);
      }
  }
}

/// The deformed shape moves along; the stored energy stays.
void DarnellTyre::follow_placement(const Vector3& old_centre, const Matrix3& old_attitude) {
  const Matrix3 turn = attitude() * old_attitude.transpose();
  const Quaternion turned(turn);
  nodes_.x = (turn * (nodes_.x.colwise() - old_centre)).colwise() + centre();
  nodes_.stop();
  for (Eigen::Index n = 0; n < nodes_.count(); ++n)
    nodes_.set_rotation(n, (turned * nodes_.q[static_cast<std::size_t>(n)]).normalized());
  compute_internal();
  zero_ = potential() - stored_;
  place_surface();
}

void DarnellTyre::follow_velocity() {
  for (Eigen::Index n = 0; n < nodes_.count(); ++n) {
    nodes_.v.col(n) = rigid_velocity(nodes_.x.col(n));
    nodes_.w.col(n) = angular_velocity();
  }
  place_surface();
}

double DarnellTyre::kinetic_energy() const {
  return hub_energy() + share_ * nodes_.kinetic_energy();
}

EnergyBudget DarnellTyre::energy_budget() const {
  EnergyBudget budget = hub_budget();
  Vector3 momentum = nodes_.v * nodes_.mass, none = Vector3::Zero();
  mirror(momentum, none);
  budget.momentum += momentum;
  budget.kinetic_energy = kinetic_energy();
  budget.stored_energy = stored_;
  budget.dissipated_energy += damped_;
  budget.contact_work = contact_work_;
  budget.load_work += inflation_work_;
  return budget;
}

/// Small velocities without pattern, the same in every run.
void DarnellTyre::disturb() {
  std::minstd_rand random(1);
  std::uniform_real_distribution<double> velocity_of(-disturbance, disturbance);
  for (Eigen::Index n = 0; n < nodes_.count(); ++n)
    for (int k = 0; k < 3; ++k) nodes_.v(k, n) += nodes_.free_to_move(k, n) * velocity_of(random);
}

Relaxation DarnellTyre::settle(RigidPlane* plane, const SettleOptions& options) {
  const double dt = stable_step_, approach = approach_time;
  const long approach_steps = std::lround(approach / dt);
  const bool follows_load = motion(z) == Motion::free && !options.axle_height;
  // any will do; one like the tread's converges fastest
  const double rim_mass = share_ * nodes_.mass.sum();
  const double turn_length = std::sqrt(nodes_.inertia.sum() / nodes_.mass.sum());
  const Matrix3X outer = surface_.f;
  KineticDamping damping;
  Relaxation result;
  Vector3 at = centre();
  const double start_height = at.z();
  double rim_velocity = 0.0, first_unbalanced = 0.0;
  disturb();
  for (result.steps = 0; result.steps < options.max_steps; ++result.steps) {
    compute_internal();
    surface_.f = outer;
    if (plane) plane->press_on(surface_);
    add_contact();
    const bool approaching = result.steps < approach_steps;
    double unbalanced = follows_load ? rim_force_.z() + contact_on_rim_.z() + load().z() : 0.0;
    if (result.steps == 0) first_unbalanced = unbalanced;
    const double time = static_cast<double>(result.steps) * dt;
    if (approaching) unbalanced -= first_unbalanced * (1.0 - smooth_step(time / approach));
    result.residual =
        std::max(nodes_.largest_unbalanced(turn_length), 0.1 * std::abs(unbalanced)) / force_scale_;
    const double carried = share_ * surface_.f.row(2).sum() + load().z();  // of the tyre as a whole
    const bool whole =
        !follows_load || std::abs(carried) < options.tolerance * std::abs(load().z());
    if (!approaching && whole && result.residual < options.tolerance) {
      result.converged = true;
      break;
    }
    nodes_.kick(dt);
    rim_velocity += dt * unbalanced / rim_mass;
    if (approaching) {
      if (options.axle_height) {
        const double next = start_height + (*options.axle_height - start_height) *
                                               smooth_step((time + dt) / approach);
        rim_velocity = (next - at.z()) / dt;
      }
      nodes_.v *= 1.0 - approach_damping * dt;
      nodes_.v.row(2).array() += approach_damping * dt * rim_velocity;
      nodes_.w *= 1.0 - approach_damping * dt;
      if (follows_load) rim_velocity *= 1.0 - approach_rim_damping * dt;
    } else {
      nodes_.v *= 1.0 - wrinkle_damping * dt;
      nodes_.w *= 1.0 - wrinkle_damping * dt;
      if (!follows_load) rim_velocity = 0.0;
      if (damping.peaked(nodes_.kinetic_energy() + 0.5 * rim_mass * rim_velocity * rim_velocity)) {
        nodes_.stop();
        rim_velocity = 0.0;
        continue;
      }
    }
    nodes_.drift(dt);
    at.z() += dt * rim_velocity;
    rest_at(at);
    place_surface();
  }
  surface_.f = outer;
  result.stops = damping.stops();
  nodes_.stop();
  stored_ = potential() - zero_;
  place_surface();
  if (!result.converged)
    throw StateError(
        fmt::format("tyre: not at rest after {} steps of relaxation; the largest unbalanced force "
                    "is {:.3g} of the "
                    "pressure's force on a node, asked for {:.3g}",
                    options.max_steps, result.residual, options.tolerance));
  return result;
}

double DarnellTyre::section_width() {
  double widest = 0.0;
  const RimPose pose = rim();
  for (SidewallRing& ring : rings_)
    for (std::size_t i = 0; i < ring.stations();
         i += std::max<std::size_t>(1, ring.stations() / 72)) {
      const Matrix3X points = ring.profile(i, nodes_, pose);
      for (Eigen::Index k = 0; k < points.cols(); ++k)
        widest =
            std::max(widest, ring.side() * (points.col(k) - centre()).dot(pose.attitude.col(1)));
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
  state.match("sidewall_points", settings_.sidewall_points);
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
  state.values("nodal_force", surface_.f);
  if (!state.saving()) place_surface();
}

}  // namespace furrow
