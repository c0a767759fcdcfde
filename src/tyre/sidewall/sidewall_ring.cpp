// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/sidewall/sidewall_ring.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/tyre/sidewall/arc.h"

namespace furrow {

SidewallRing::SidewallRing(std::unique_ptr<Sidewall> sidewall, const TyreParameters& tyre, int side,
                           std::vector<int> edge, double width)
    : sidewall_(std::move(sidewall)),
      side_(side),
      edge_(std::move(edge)),
      width_(width),
      length_(tyre.sidewall.length),
      linked_(!tyre.link.isZero(0.0)),
      bead_(3, static_cast<Eigen::Index>(edge_.size())),
      link_(3, bead_.cols()),
      on_node_(3, bead_.cols()),
      on_end_(3, bead_.cols()),
      ends_(edge_.size()),
      responses_(edge_.size()),
      located_(edge_.size()) {
  for (Eigen::Index i = 0; i < bead_.cols(); ++i) {
    const double angle = 2.0 * pi * static_cast<double>(i) / static_cast<double>(bead_.cols());
    bead_.col(i) << tyre.bead_radius * std::sin(angle), 0.5 * side_ * tyre.bead_spacing,
        -tyre.bead_radius * std::cos(angle);
    link_.col(i) << tyre.link[1] * std::sin(angle), side_ * tyre.link[0],
        -tyre.link[1] * std::cos(angle);
  }
}

SidewallRing::Station SidewallRing::locate(std::size_t station, const ShellNodes& nodes,
                                           const RimPose& rim) const {
  const Eigen::Index node = edge_[station];
  Station s;
  s.A = side_ * rim.attitude.col(1);
  const Matrix3 Q = nodes.q[static_cast<std::size_t>(node)].toRotationMatrix();
  s.arm = Q * link_.col(static_cast<Eigen::Index>(station));
  const Vector3 d = nodes.x.col(node) + s.arm - rim.centre - rim.attitude * bead(station);
  s.end.a = d.dot(s.A);
  const Vector3 radial = d - s.end.a * s.A;
  s.end.r = radial.norm();
  s.e_r = radial / s.end.r;
  s.g = side_ * Q.col(1);
  s.end.phi = std::atan2(s.g.dot(s.e_r), s.g.dot(s.A));
  return s;
}

void SidewallRing::add_forces(ShellNodes& nodes, const RimPose& rim) {
  for (std::size_t i = 0; i < stations(); ++i) {
    located_[i] = locate(i, nodes, rim);
    ends_[i] = located_[i].end;
  }
  try {
    sidewall_->evaluate(ends_.data(), responses_.data(), stations(), false);
  } catch (const StateError& error) {
    throw StateError(fmt::format("sidewall at {}y, {}", side_ > 0 ? "+" : "-", error.what()));
  }
  add_sidewalls(nodes);
  add_pressure(nodes, rim);
  for (std::size_t i = 0; i < stations(); ++i) {
    const Eigen::Index node = edge_[i];
    const auto station = static_cast<Eigen::Index>(i);
    nodes.force.col(node) += on_node_.col(station) + on_end_.col(station);
    nodes.moment.col(node) += located_[i].arm.cross(Vector3(on_end_.col(station)));
  }
}

/// Forces of the sidewalls on the ends of the links: sets on_end_, and clears on_node_. Their
/// moments on the nodes, by
///   d(phi) = (g_a d(g_r) - g_r d(g_a))/h^2,  d(g) = d(theta) x g,
/// where e_r follows the node.
void SidewallRing::add_sidewalls(ShellNodes& nodes) {
  potential_ = 0.0;
  largest_chord_ = 0.0;
  on_node_.setZero();
  for (std::size_t i = 0; i < stations(); ++i) {
    const Station& s = located_[i];
    const SidewallEnd& end = s.end;
    const SidewallResponse& response = responses_[i];
    const double F_a = width_ * response.force[0];
    const double F_r = width_ * response.force[1];
    const double M = width_ * response.force[2];
    const double g_a = s.g.dot(s.A);
    const double g_r = s.g.dot(s.e_r);
    const double h2 = g_a * g_a + g_r * g_r;
    const Vector3 across = s.g - g_a * s.A - g_r * s.e_r;
    on_end_.col(static_cast<Eigen::Index>(i)) =
        F_a * s.A + F_r * s.e_r + (M * g_a / (h2 * end.r)) * across;
    nodes.moment.col(edge_[i]) += (M / h2) * s.g.cross(g_a * s.e_r - g_r * s.A);
    potential_ += width_ * response.potential;
    largest_chord_ = std::max(largest_chord_, std::hypot(end.a, end.r) / length_);
  }
}

/// Consistent forces of a unit pressure on a bilinear quadrilateral, along its normal by the
/// right-hand rule [m^2].
void SidewallRing::unit_pressure(const Vector3 (&x)[4], Vector3 (&force)[4]) {
  constexpr double xi[4] = {-1, 1, 1, -1};
  constexpr double eta[4] = {-1, -1, 1, 1};
  const Vector3 A = 0.25 * (x[1] + x[2] - x[0] - x[3]);
  const Vector3 B = 0.25 * (x[2] + x[3] - x[0] - x[1]);
  const Vector3 C = 0.25 * (x[0] - x[1] + x[2] - x[3]);
  const Vector3 AB = A.cross(B);
  const Vector3 AC = A.cross(C) / 3.0;
  const Vector3 CB = C.cross(B) / 3.0;
  for (int k = 0; k < 4; ++k) force[k] = AB + xi[k] * AC + eta[k] * CB;
}

/// Adds pressure on quadrilaterals: end i, end i + 1, bead i + 1, bead i, and with links also node
/// i, node i + 1, end i + 1, end i. In this order their normal is outwards at -y.
void SidewallRing::add_pressure(const ShellNodes& nodes, const RimPose& rim) {
  const double p = -side_ * sidewall_->pressure();
  volume_ = 0.0;
  Vector3 force[4];
  const auto press = [&](const Vector3(&x)[4]) {
    unit_pressure(x, force);
    for (int k = 0; k < 4; ++k) {
      volume_ -= side_ * force[k].dot(x[k]) / 3.0;
      force[k] = p * force[k];
    }
  };
  Vector3 bead_here = rim.centre + rim.attitude * bead(0);
  for (std::size_t i = 0; i < stations(); ++i) {
    const std::size_t next = (i + 1) % stations();
    const auto here = static_cast<Eigen::Index>(i);
    const auto there = static_cast<Eigen::Index>(next);
    const Vector3 node_here = nodes.x.col(edge_[i]);
    const Vector3 node_there = nodes.x.col(edge_[next]);
    const Vector3 end_here = node_here + located_[i].arm;
    const Vector3 end_there = node_there + located_[next].arm;
    const Vector3 bead_there = rim.centre + rim.attitude * bead(next);
    press({end_here, end_there, bead_there, bead_here});
    on_end_.col(here) += force[0];
    on_end_.col(there) += force[1];
    if (linked_) {
      press({node_here, node_there, end_there, end_here});
      on_node_.col(here) += force[0];
      on_node_.col(there) += force[1];
      on_end_.col(there) += force[2];
      on_end_.col(here) += force[3];
    }
    bead_here = bead_there;
  }
}

Matrix3X SidewallRing::profile(std::size_t station, const ShellNodes& nodes, const RimPose& rim) {
  const Station s = locate(station, nodes, rim);
  const Eigen::Matrix2Xd chain = sidewall_->shape(s.end).nodes;
  Matrix3X points(3, chain.cols());
  for (Eigen::Index k = 0; k < chain.cols(); ++k)
    points.col(k) =
        rim.centre + rim.attitude * bead(station) + chain(0, k) * s.A + chain(1, k) * s.e_r;
  return points;
}

void SidewallRing::arcs(int points, const ShellNodes& nodes, const RimPose& rim, Matrix3X& x,
                        Eigen::Index first) const {
  for (std::size_t i = 0; i < stations(); ++i) {
    const Station s = locate(i, nodes, rim);
    const Arc arc(rim.centre + rim.attitude * bead(i), nodes.x.col(edge_[i]) + s.arm, length_, s.A);
    for (int k = 0; k < points; ++k) x.col(first++) = arc.point(static_cast<double>(k) / points);
  }
}

}  // namespace furrow
