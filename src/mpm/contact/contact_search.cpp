// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/contact/contact_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "furrow/geometry/closest_feature.h"
#include "furrow/geometry/triangle_search.h"

namespace furrow {

namespace {

constexpr double skin_cells = 0.5;  // of the shortest cell

/// Smallest box around this rank's particles.
std::pair<Vector3, Vector3> bounds_of(const std::vector<ParticleGroup>& groups) {
  Vector3 lower = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 upper = -lower;
  for (const ParticleGroup& group : groups)
    for (std::size_t p = 0; p < group.particles.size(); ++p) {
      const Vector3 x = group.particles.position(p);
      lower = lower.cwiseMin(x);
      upper = upper.cwiseMax(x);
    }
  return {lower, upper};
}

}  // namespace

ContactSearch::ContactSearch(const Body& body, ContinuumTerrain& terrain)
    : body_(body), terrain_(terrain) {}

bool ContactSearch::is_outdated() {
  const Matrix3X& nodes = body_.surface().x;
  if (generation_ != terrain_.generation()) return true;
  surface_travel_ = std::sqrt((nodes - searched_nodes_).colwise().squaredNorm().maxCoeff());
  return surface_travel_ + terrain_travel_ > skin_;
}

void ContactSearch::search() {
  find_candidates();
  searched_nodes_ = body_.surface().x;
  generation_ = terrain_.generation();
  surface_travel_ = 0.0;
  terrain_travel_ = 0.0;
}

/// The largest distance from a particle near the surface to the end of the ground that it stands
/// for [m].
double ContactSearch::largest_particle_reach() const {
  const auto [low, high] = body_.surface().bounds();
  double reach = 0.0;
  for (const ParticleGroup& group : terrain_.unsynchronised_groups())
    for (std::size_t p = 0; p < group.particles.size(); ++p) {
      const Vector3 x = group.particles.position(p);
      const Vector3 half = group.particles.half_spacing(p);
      if ((x.array() > low.array() - 4.0 * half.array() - skin_).all() &&
          (x.array() < high.array() + 4.0 * half.array() + skin_).all())
        reach = std::max(reach, half.norm() * std::max(1.0, group.particles.volume_ratio(p)));
    }
  return reach;
}

void ContactSearch::find_candidates() {
  const double cell = terrain_.grid().shortest_cell();
  const std::vector<ParticleGroup>& groups = terrain_.unsynchronised_groups();
  skin_ = skin_cells * cell;
  staleness_ = terrain_.staleness();
  const double reach = largest_particle_reach() + skin_ + max_penetration_cells * cell + staleness_;
  candidates_.clear();
  near_triangles_.clear();
  const auto [lower, upper] = bounds_of(groups);
  const TriangleSearch triangles(body_.surface(), reach, lower, upper);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Particles& particles = groups[g].particles;
    for (std::size_t p = 0; p < particles.size(); ++p)
      add_candidate(triangles, {g, p}, particles.position(p), reach);
  }
}

/// Lists a particle with its triangles, if there are any within reach.
void ContactSearch::add_candidate(const TriangleSearch& triangles, const ParticleIndex& particle,
                                  const Vector3& position, double reach) {
  const auto [first, last] = triangles.near(position);
  if (first == last) return;
  const Surface& surface = body_.surface();
  const std::size_t begin = near_triangles_.size();
  for (const int* t = first; t != last; ++t) {
    const Vector3i& n = surface.triangles[static_cast<std::size_t>(*t)];
    const double distance = closest_point_on_triangle(position, surface.x.col(n[0]),
                                                      surface.x.col(n[1]), surface.x.col(n[2]))
                                .distance;
    if (distance <= reach) near_triangles_.push_back({distance, *t});
  }
  if (near_triangles_.size() == begin) return;
  std::sort(near_triangles_.begin() + static_cast<std::ptrdiff_t>(begin), near_triangles_.end(),
            [](const NearTriangle& a, const NearTriangle& b) { return a.distance < b.distance; });
  candidates_.push_back({particle, position, begin, near_triangles_.size()});
}

}  // namespace furrow
