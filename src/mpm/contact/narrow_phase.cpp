// SPDX-License-Identifier: GPL-2.0-or-later
#include "mpm/contact/narrow_phase.h"

#include <algorithm>
#include <limits>

#include "geometry/closest_feature.h"

namespace furrow {

namespace {

// of half the spacing: closer, the separation is rounding and has no direction
constexpr double no_distance = 1e-9;

/// The closest point of a candidate's triangles. Of equally near triangles the one with the lowest
/// number counts, in whatever order they come.
ClosestPoint closest_point(const Surface& surface, const ContactSearch& search,
                           const ContactSearch::Candidate& candidate, const Vector3& position,
                           std::size_t& triangle) {
  ClosestPoint closest{};
  closest.distance = std::numeric_limits<double>::infinity();
  triangle = 0;
  // A triangle that was farther by more than both have moved since is farther still.
  const double approach = search.surface_travel() + (position - candidate.position).norm();
  for (std::size_t n = candidate.first;
       n < candidate.last && search.near_triangle(n).distance - approach <= closest.distance; ++n) {
    const auto t = static_cast<std::size_t>(search.near_triangle(n).triangle);
    const Vector3i& node = surface.triangles[t];
    const ClosestPoint point = closest_point_on_triangle(
        position, surface.x.col(node[0]), surface.x.col(node[1]), surface.x.col(node[2]));
    if (point.distance < closest.distance || (point.distance == closest.distance && t < triangle)) {
      closest = point;
      triangle = t;
    }
  }
  return closest;
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
  const ClosestPoint closest =
      closest_point(surface, search, candidate, position, contact.triangle);
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
  return contact;
}

void NarrowPhase::follow(const Vector3& velocity, double dt, const Particles& particles,
                         std::size_t particle, ContactHistory& history, ContactPoint& contact) {
  contact.gap = std::min(history.gap + 0.5 * dt * velocity.dot(history.normal + contact.normal),
                         contact.distance);
  history.reach_excess =
      (contact.distance - contact.gap) / reach(particles, particle, contact.normal) - 1.0;
}

}  // namespace furrow
