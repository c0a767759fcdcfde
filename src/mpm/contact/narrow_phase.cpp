// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/contact/narrow_phase.h"

#include <algorithm>
#include <limits>

#include "furrow/geometry/closest_feature.h"

namespace furrow {

namespace {

// Separation over half the spacing, below which it is rounding and has no direction
constexpr double no_distance = 1e-9;

// Fractions of half the spacing. A closest point that is farther than this from where the particle
// touched lies on another facet; it must be closer by the gain.
constexpr double switch_length = 0.25;
constexpr double switch_gain = 0.1;

/// The nearest triangle so far. Among equally near ones the lowest number counts, so that their
/// order does not matter.
struct Nearest {
  ClosestPoint point{};
  std::size_t triangle = 0;

  Nearest() { point.distance = std::numeric_limits<double>::infinity(); }
  void consider(const ClosestPoint& other, std::size_t t) {
    if (other.distance > point.distance || (other.distance == point.distance && t > triangle))
      return;
    point = other;
    triangle = t;
  }
};

/// Place where a particle touched, and the rule by which it switches to another facet.
struct LastTouch {
  Vector3 point;         // of the surface now [m]
  double switch_length;  // [m]
  double switch_gain;    // [m]
};

/// The closest point of a candidate's triangles, or one near the last touch that is hardly farther.
/// @param last  null for a particle that did not touch
Nearest closest_point(const Surface& surface, const ContactSearch& search,
                      const ContactSearch::Candidate& candidate, const Vector3& position,
                      const LastTouch* last) {
  Nearest nearest, near_last;
  // A triangle that was farther by more than both have moved since is farther still.
  const double approach = search.surface_travel() + (position - candidate.position).norm() +
                          (last != nullptr ? last->switch_gain : 0.0);
  for (std::size_t n = candidate.first;
       n < candidate.last && search.near_triangle(n).distance - approach <= nearest.point.distance;
       ++n) {
    const auto t = static_cast<std::size_t>(search.near_triangle(n).triangle);
    const Vector3i& node = surface.triangles[t];
    const ClosestPoint point = closest_point_on_triangle(
        position, surface.x.col(node[0]), surface.x.col(node[1]), surface.x.col(node[2]));
    nearest.consider(point, t);
    if (last != nullptr && (position - point.separation - last->point).norm() < last->switch_length)
      near_last.consider(point, t);
  }
  const bool stays =
      last != nullptr && near_last.point.distance < nearest.point.distance + last->switch_gain;
  return stays ? near_last : nearest;
}

}  // namespace

NarrowPhase::NarrowPhase(const Body& body) : body_(body), node_triangles_(body.surface()) {}

ContactPoint NarrowPhase::find(const ContactSearch& search,
                               const ContactSearch::Candidate& candidate,
                               const Particles& particles, const Vector3& position,
                               const ContactHistory& history) const {
  const Surface& surface = body_.surface();
  const std::size_t p = candidate.particle.particle;
  ContactPoint contact;
  const double size = particles.half_spacing(p).minCoeff();
  LastTouch last;
  if (history.touches())
    last = {point_of(surface.x, history), switch_length * size, switch_gain * size};
  const Nearest nearest =
      closest_point(surface, search, candidate, position, history.touches() ? &last : nullptr);
  const ClosestPoint& closest = nearest.point;
  contact.triangle = nearest.triangle;
  const Vector3 outward = node_triangles_.outward(surface, contact.triangle, closest.barycentric);
  const bool outside = closest.separation.dot(outward) >= 0.0;

  const double side = outside ? 1.0 : -1.0;
  const auto gap = [&](double distance, const Vector3& normal) {
    return distance - (1.0 + history.reach_excess) * reach(particles, p, normal);
  };
  contact.normal = closest.distance > no_distance * particles.half_spacing(p).norm()
                       ? Vector3(side / closest.distance * closest.separation)
                       : outward.normalized();
  contact.distance = side * closest.distance;
  contact.gap = gap(contact.distance, contact.normal);
  // Beside an edge, the direction of the closest point is not the one that separates: of it and of
  // the triangles' normals, the one with the largest gap does (separating axes). Without this,
  // ground level with a plate is pushed away from the plate's edge.
  if (outside && contact.gap < 0.0 && closest.feature_nodes() < 3)
    node_triangles_.for_normals(surface, contact.triangle, closest.barycentric,
                                [&](const Vector3& normal) {
                                  const double distance = closest.separation.dot(normal);
                                  if (gap(distance, normal) <= contact.gap) return;
                                  contact.normal = normal;
                                  contact.distance = distance;
                                  contact.gap = gap(distance, normal);
                                });
  contact.position = position - closest.separation;
  contact.barycentric = closest.barycentric;
  contact.switches_facet =
      history.touches() && (contact.position - last.point).norm() > last.switch_length;
  return contact;
}

Vector3 NarrowPhase::point_of(const Matrix3X& nodal, const ContactHistory& history) const {
  const Vector3i& node = body_.surface().triangles[static_cast<std::size_t>(history.triangle)];
  Vector3 value = Vector3::Zero();
  for (int c = 0; c < 3; ++c) value += history.barycentric[c] * nodal.col(node[c]);
  return value;
}

void NarrowPhase::follow(const Vector3& velocity, const Vector3& velocity_there, double dt,
                         const Particles& particles, std::size_t particle, ContactHistory& history,
                         ContactPoint& contact) {
  const double approach = velocity.dot(history.normal + contact.normal) +
                          (velocity_there - velocity).dot(history.normal);
  contact.gap = std::min(history.gap + 0.5 * dt * approach, contact.distance);
  history.reach_excess =
      (contact.distance - contact.gap) / reach(particles, particle, contact.normal) - 1.0;
}

}  // namespace furrow
