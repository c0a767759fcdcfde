// SPDX-License-Identifier: GPL-2.0-or-later
#include "tyre/sidewall_ring.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"

namespace furrow {

namespace {

/// Half the angle an arc turns by, from chord over length: sin(alpha)/alpha = share; alpha in (0,
/// pi).
double half_turn(double share) {
  if (share >= 1.0) return 0.0;
  double alpha = std::min(3.0, std::sqrt(6.0 * (1.0 - share) * (1.0 + 0.15 * (1.0 - share))));
  for (int i = 0; i < 8; ++i) {
    const double s = std::sin(alpha), change = (s - share * alpha) / (share - std::cos(alpha));
    alpha = std::clamp(alpha + change, 0.25 * alpha, 0.5 * (alpha + pi));
    if (std::abs(change) < 1e-12) break;
  }
  return alpha;
}

}  // namespace

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
      axes_(edge_.size()) {
  for (Eigen::Index i = 0; i < bead_.cols(); ++i) {
    const double angle = 2.0 * pi * static_cast<double>(i) / static_cast<double>(bead_.cols());
    bead_.col(i) << tyre.bead_radius * std::sin(angle), 0.5 * side_ * tyre.bead_spacing,
        -tyre.bead_radius * std::cos(angle);
    link_.col(i) << tyre.link[1] * std::sin(angle), side_ * tyre.link[0],
        -tyre.link[1] * std::cos(angle);
  }
}

SidewallRing::Axes SidewallRing::axes(std::size_t station, const ShellNodes& nodes,
                                      const RimPose& rim) const {
  const Eigen::Index node = edge_[station];
  Axes axes;
  axes.A = side_ * rim.attitude.col(1);
  const Eigen::Map<const Matrix3> Q(nodes.rotation.col(node).data());
  axes.arm = Q * link_.col(static_cast<Eigen::Index>(station));
  const Vector3 d = nodes.x.col(node) + axes.arm - rim.centre - rim.attitude * bead(station);
  axes.end.a = d.dot(axes.A);
  const Vector3 radial = d - axes.end.a * axes.A;
  axes.end.r = radial.norm();
  axes.e_r = radial / axes.end.r;
  axes.g = side_ * Q.col(1);
  axes.end.phi = std::atan2(axes.g.dot(axes.e_r), axes.g.dot(axes.A));
  return axes;
}

void SidewallRing::add_forces(ShellNodes& nodes, const RimPose& rim) {
  for (std::size_t i = 0; i < stations(); ++i) {
    axes_[i] = axes(i, nodes, rim);
    ends_[i] = axes_[i].end;
  }
  try {
    sidewall_->evaluate(ends_.data(), responses_.data(), stations(), false);
  } catch (const StateError& error) {
    throw StateError(fmt::format("sidewall at {}y, {}", side_ > 0 ? "+" : "-", error.what()));
  }
  potential_ = largest_chord_ = 0.0;
  on_node_.setZero();
  for (std::size_t i = 0; i < stations(); ++i) {
    const Axes& s = axes_[i];
    const SidewallEnd& end = s.end;
    const SidewallResponse& response = responses_[i];
    const Eigen::Index node = edge_[i];
    const double F_a = width_ * response.force[0], F_r = width_ * response.force[1],
                 M = width_ * response.force[2];
    // d(phi) = (g_a d(g_r) - g_r d(g_a))/h^2, d(g) = d(theta) x g, and e_r turns with the node
    const double g_a = s.g.dot(s.A), g_r = s.g.dot(s.e_r), h2 = g_a * g_a + g_r * g_r;
    const Vector3 across = s.g - g_a * s.A - g_r * s.e_r;
    on_end_.col(static_cast<Eigen::Index>(i)) =
        F_a * s.A + F_r * s.e_r + (M * g_a / (h2 * end.r)) * across;
    nodes.moment.col(node) += (M / h2) * s.g.cross(g_a * s.e_r - g_r * s.A);
    potential_ += width_ * response.potential;
    largest_chord_ = std::max(largest_chord_, std::hypot(end.a, end.r) / length_);
  }
  add_pressure(nodes, rim);
  for (std::size_t i = 0; i < stations(); ++i) {
    const Eigen::Index node = edge_[i], station = static_cast<Eigen::Index>(i);
    nodes.force.col(node) += on_node_.col(station) + on_end_.col(station);
    nodes.moment.col(node) += axes_[i].arm.cross(Vector3(on_end_.col(station)));
  }
}

/// Consistent forces of a pressure on bilinear quadrilaterals: end i, end i + 1, bead i + 1, bead
/// i, and with links also node i, node i + 1, end i + 1, end i.
void SidewallRing::add_pressure(const ShellNodes& nodes, const RimPose& rim) {
  constexpr double xi[4] = {-1, 1, 1, -1}, eta[4] = {-1, -1, 1, 1};
  // in this order of nodes the normal is outwards at -y
  const double p = -side_ * sidewall_->pressure();
  volume_ = 0.0;
  const auto press = [&](const Vector3(&x)[4], Vector3(&force)[4]) {
    const Vector3 A = 0.25 * (x[1] + x[2] - x[0] - x[3]), B = 0.25 * (x[2] + x[3] - x[0] - x[1]),
                  C = 0.25 * (x[0] - x[1] + x[2] - x[3]);
    const Vector3 AB = A.cross(B), AC = A.cross(C) / 3.0, CB = C.cross(B) / 3.0;
    for (int k = 0; k < 4; ++k) {
      const Vector3 push = AB + xi[k] * AC + eta[k] * CB;
      volume_ -= side_ * push.dot(x[k]) / 3.0;
      force[k] = p * push;
    }
  };
  Vector3 force[4], bead_here = rim.centre + rim.attitude * bead(0);
  for (std::size_t i = 0; i < stations(); ++i) {
    const std::size_t next = (i + 1) % stations();
    const Eigen::Index here = static_cast<Eigen::Index>(i), there = static_cast<Eigen::Index>(next);
    const Vector3 node_here = nodes.x.col(edge_[i]), node_there = nodes.x.col(edge_[next]);
    const Vector3 end_here = node_here + axes_[i].arm, end_there = node_there + axes_[next].arm;
    const Vector3 bead_there = rim.centre + rim.attitude * bead(next);
    press({end_here, end_there, bead_there, bead_here}, force);
    on_end_.col(here) += force[0];
    on_end_.col(there) += force[1];
    if (linked_) {
      press({node_here, node_there, end_there, end_here}, force);
      on_node_.col(here) += force[0];
      on_node_.col(there) += force[1];
      on_end_.col(there) += force[2];
      on_end_.col(here) += force[3];
    }
    bead_here = bead_there;
  }
}

Matrix3X SidewallRing::profile(std::size_t station, const ShellNodes& nodes, const RimPose& rim) {
  const Axes s = axes(station, nodes, rim);
  Eigen::Matrix2Xd chain;
  sidewall_->profile(s.end, chain);
  Matrix3X points(3, chain.cols());
  for (Eigen::Index k = 0; k < chain.cols(); ++k)
    points.col(k) =
        rim.centre + rim.attitude * bead(station) + chain(0, k) * s.A + chain(1, k) * s.e_r;
  return points;
}

void SidewallRing::arcs(int points, const ShellNodes& nodes, const RimPose& rim, Matrix3X& x,
                        Eigen::Index first) const {
  for (std::size_t i = 0; i < stations(); ++i) {
    const Axes s = axes(i, nodes, rim);
    const Vector3 start = rim.centre + rim.attitude * bead(i),
                  along = nodes.x.col(edge_[i]) + s.arm - start;
    const double chord = along.norm(), alpha = half_turn(chord / length_);
    const Vector3 t = along / chord, out = (s.A - s.A.dot(t) * t).normalized();
    const double radius = alpha > 1e-6 ? 0.5 * chord / std::sin(alpha) : 0.0;
    for (int k = 0; k < points; ++k) {
      // from -alpha at the bead
      const double at = static_cast<double>(k) / points, beta = alpha * (2.0 * at - 1.0);
      const double forward = radius > 0.0 ? radius * std::sin(beta) : chord * (at - 0.5);
      const double bulge = radius > 0.0 ? radius * (std::cos(beta) - std::cos(alpha)) : 0.0;
      x.col(first++) = start + (0.5 * chord + forward) * t + bulge * out;
    }
  }
}

}  // namespace furrow
