// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/brick/brick_tyre.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "furrow/core/options/check_number.h"

namespace furrow {

namespace {

// Share of the bricks' own step: their stiffness follows the deformation, a step goes before it
constexpr double brick_reserve = 0.9;
// Share of their height to which bricks may be squeezed while a tyre settles
constexpr double relaxation_reserve = 0.7;
// [kg m^2] of nodes that no shell has: they do not turn, but are divided by
constexpr double no_inertia = 1e-30;

BrickTyreMesh checked_mesh(const BrickTyreParameters& tyre, const BrickTyreSettings& settings,
                           const HubParameters& hub, const std::string& where) {
  check(tyre, where);
  check(settings, where);
  check(hub, where);
  return make_brick_tyre_mesh(tyre, settings.sections, settings.half, where);
}

}  // namespace

void check(const BrickTyreSettings& settings, const std::string& where) {
  check_integer(settings.sections, Range::closed(12, 1000), where + ", sections");
  check_number(settings.damping_rate, Range::non_negative(), where + ", damping rate", "1/s");
}

BrickTyre::BrickTyre(const BrickTyreParameters& tyre, const BrickTyreSettings& settings,
                     const HubParameters& hub, const std::string& where)
    : BrickTyre(tyre, settings, hub, checked_mesh(tyre, settings, hub, where)) {}

BrickTyre::BrickTyre(const BrickTyreParameters& tyre, const BrickTyreSettings& settings,
                     const HubParameters& hub, BrickTyreMesh mesh)
    : NodalTyre(hub, {mesh.x, tyre.pressure, settings.damping_rate}),
      tyre_(tyre),
      settings_(settings),
      mesh_(std::move(mesh)),
      bricks_(mesh_.x, mesh_.bricks, tyre.tread.rubber) {
  nodes_.mass = bricks_.mass();
  nodes_.inertia.setConstant(no_inertia);
  const auto turning = tyre.carcass.cords ? Shell4Turning::first_median : Shell4Turning::polar;
  for (std::size_t zone = 0; zone < mesh_.quads.size(); ++zone) {
    const CarcassZone& of = tyre.carcass.zones[zone];
    shells_.emplace_back(mesh_.x, mesh_.quads[zone], ShellSection(of.wall, of.areal_mass),
                         circumferential, turning);
    nodes_.mass += shells_.back().mass();
    nodes_.inertia += shells_.back().rotary_inertia();
  }
  for (Eigen::Index n = mesh_.carcass_nodes; n < nodes_.count(); ++n)
    nodes_.free_to_turn.col(n).setZero();
  for (const int n : mesh_.in_symmetry_plane) hold_in_symmetry_plane(n);
  for (const int n : mesh_.beads) carry_by_rim(n);
  surface_.resize(mesh_.surface_nodes.size());
  surface_.triangles = mesh_.triangles;
  start();
  set_tread_mass();
}

void BrickTyre::set_tread_mass() {
  const VectorX area = surface_.node_areas();
  tread_mass_ = std::numeric_limits<double>::infinity();
  for (Eigen::Index n = 0; n < mesh_.grid.count(); ++n)
    tread_mass_ = std::min(tread_mass_,
                           nodes_.mass[mesh_.surface_nodes[static_cast<std::size_t>(n)]] / area[n]);
}

double BrickTyre::step_with(double reserve) const {
  double step = reserve * bricks_.stable_time_step();
  for (const Shell4& shell : shells_) step = std::min(step, shell.stable_time_step());
  return step;
}

double BrickTyre::stable_time_step() const { return step_with(brick_reserve); }
double BrickTyre::relaxation_step() const { return step_with(relaxation_reserve); }

NodeNeighbours BrickTyre::neighbours() const {
  NodeNeighbours found(static_cast<std::size_t>(nodes_.count()));
  for (const Shell4& shell : shells_) add_neighbours(shell.quads(), found);
  add_neighbours(bricks_.bricks(), found);
  return found;
}

NodalTyre::Internal BrickTyre::add_internal_forces() {
  bricks_.add_forces(nodes_.x, nodes_.force);
  Internal internal{bricks_.energy(), 0.0};
  for (Shell4& shell : shells_) {
    shell.add_forces(nodes_, pressure());
    internal.energy += shell.energy();
    internal.volume += shell.volume();
  }
  return internal;
}

void BrickTyre::place_surface() {
  for (Eigen::Index k = 0; k < surface_.x.cols(); ++k) {
    const int node = mesh_.surface_nodes[static_cast<std::size_t>(k)];
    surface_.x.col(k) = nodes_.x.col(node);
    surface_.v.col(k) = nodes_.v.col(node);
  }
}

Wrench BrickTyre::hand_over(Matrix3X& on_nodes) {
  on_nodes.setZero(3, nodes_.count());
  for (Eigen::Index k = 0; k < surface_.x.cols(); ++k)
    on_nodes.col(mesh_.surface_nodes[static_cast<std::size_t>(k)]) = surface_.f.col(k);
  Wrench on_rim;
  for (const int bead : mesh_.beads) {
    const Vector3 force = on_nodes.col(bead);
    on_rim.force += force;
    on_rim.moment += Vector3(nodes_.x.col(bead) - centre()).cross(force);
    on_nodes.col(bead).setZero();
  }
  return on_rim;
}

/// Point of a line of the unloaded tread farthest from the axle; a line may have voids.
Vector3 BrickTyre::unloaded_tread_point(int line) const {
  Vector3 highest = Vector3::Zero();
  for (int i = 0; i < mesh_.grid.around; ++i) {
    const Vector3 at =
        reference().col(mesh_.surface_nodes[static_cast<std::size_t>(mesh_.grid.node(i, line))]);
    if (Vector2(at.x(), at.z()).norm() > Vector2(highest.x(), highest.z()).norm()) highest = at;
  }
  return highest;
}

double BrickTyre::section_width() {
  double widest = 0.0;
  const Vector3 a = axle();
  for (Eigen::Index n = 0; n < mesh_.carcass_nodes; ++n)
    widest = std::max(widest, std::abs((nodes_.x.col(n) - centre()).dot(a)));
  return 2.0 * widest;
}

double BrickTyre::largest_sidewall_chord() const {
  double largest = 0.0;
  for (int i = 0; i < settings_.sections; ++i) {
    const int first = i * mesh_.stations + mesh_.tread_end;
    const int bead = (i + 1) * mesh_.stations - 1;
    double length = 0.0;
    for (int n = first; n < bead; ++n)
      length += (reference().col(n + 1) - reference().col(n)).norm();
    largest = std::max(largest, (nodes_.x.col(bead) - nodes_.x.col(first)).norm() / length);
  }
  return largest;
}

void BrickTyre::checkpoint(Checkpoint& state) {
  state.match("sections", settings_.sections);
  state.match("half", settings_.half);
  state.match("nodes", nodes_.count());
  state.match("tread_radius", tyre_.radius());
  state.match("shear_modulus", tyre_.tread.rubber.law.shear);
  checkpoint_nodes(state);
  bricks_.checkpoint(state);
}

}  // namespace furrow
