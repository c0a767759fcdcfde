// SPDX-License-Identifier: GPL-2.0-or-later
#include "mpm/contact/narrow_phase.h"

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

bool NarrowPhase::find(const ContactSearch& search, const ContactSearch::Candidate& candidate,
                       const Particles& particles, const Vector3& position,
                       ContactPoint& contact) const {
  const Surface& surface = body_.surface();
  const std::size_t p = candidate.particle.particle;
  const ClosestPoint closest =
      closest_point(surface, search, candidate, position, contact.triangle);
  const Vector3 outward = node_triangles_.outward(surface, contact.triangle, closest.barycentric);
  const bool outside = closest.separation.dot(outward) >= 0.0;
  if (outside && closest.distance > reach(particles, p)) return false;

  const double side = outside ? 1.0 : -1.0;
  const Vector3 half = particles.half_spacing(p);
  const double ratio = particles.volume_ratio(p);
  contact.normal = closest.distance > no_distance * half.norm()
                       ? Vector3(side / closest.distance * closest.separation)
                       : outward.normalized();
  contact.gap = side * closest.distance - ratio * contact.normal.cwiseAbs().dot(half);
  // Beside an edge, the direction of the closest point is not the one that separates: of it and of
  // the triangles' normals, the one with the largest gap does (separating axes). Without this,
  // ground level with a plate is pushed away from the plate's edge.
  if (outside && closest.feature_nodes() < 3)
    node_triangles_.for_normals(
        surface, contact.triangle, closest.barycentric, [&](const Vector3& normal) {
          const double gap = closest.separation.dot(normal) - ratio * normal.cwiseAbs().dot(half);
          if (gap <= contact.gap) return;
          contact.gap = gap;
          contact.normal = normal;
        });
  contact.position = position - closest.separation;
  contact.barycentric = closest.barycentric;
  return contact.gap < 0.0;
}

}  // namespace furrow
