// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/geometry/closest_feature.h"

namespace furrow {

namespace {

bool contains(const Vector3i& nodes, int node) {
  return nodes[0] == node || nodes[1] == node || nodes[2] == node;
}

bool share_node(const Vector3i& a, const Vector3i& b) {
  return contains(b, a[0]) || contains(b, a[1]) || contains(b, a[2]);
}

/// Every node of the feature on which this candidate's closest point lies belongs to the triangle
/// other.
bool feature_belongs_to(const ContactCandidate& candidate, const ContactCandidate& other) {
  for (int j = 0; j < 3; ++j)
    if (candidate.point.barycentric[j] > 0.0 && !contains(other.nodes, candidate.nodes[j]))
      return false;
  return true;
}

/// The surface comes nearer to the sphere's centre on other, which contains candidate's feature.
bool is_owned_by(const ContactCandidate& candidate, const ContactCandidate& other,
                 double tolerance) {
  if (candidate.point.feature_nodes() == 3 || !feature_belongs_to(candidate, other)) return false;
  const double difference = other.point.distance - candidate.point.distance;
  if (difference < -tolerance) return true;
  if (difference > tolerance) return false;
  const int nodes = candidate.point.feature_nodes(), other_nodes = other.point.feature_nodes();
  return other_nodes > nodes || (other_nodes == nodes && other.triangle < candidate.triangle);
}

}  // namespace

ClosestPoint closest_point_on_triangle(const Vector3& p, const Vector3& a, const Vector3& b,
                                       const Vector3& c) {
  const Vector3 ab = b - a, ac = c - a, ap = p - a;
  const auto at = [&](double wa, double wb, double wc) {
    ClosestPoint result;
    result.barycentric = Vector3(wa, wb, wc);
    result.separation = ap - wb * ab - wc * ac;
    result.distance = result.separation.norm();
    return result;
  };

  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return at(1.0, 0.0, 0.0);

  const Vector3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return at(0.0, 1.0, 0.0);

  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    const double w = d1 / (d1 - d3);
    return at(1.0 - w, w, 0.0);
  }

  const Vector3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return at(0.0, 0.0, 1.0);

  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    const double w = d2 / (d2 - d6);
    return at(1.0 - w, 0.0, w);
  }

  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return at(0.0, 1.0 - w, w);
  }

  const double scale = 1.0 / (va + vb + vc);
  return at(va * scale, vb * scale, vc * scale);
}

void ContactSelection::select(std::vector<ContactCandidate>& candidates, double radius) const {
  if (candidates.size() < 2) return;
  const double tolerance = 1e-9 * radius;

  for (ContactCandidate& candidate : candidates)
    candidate.owned =
        std::any_of(candidates.begin(), candidates.end(), [&](const ContactCandidate& other) {
          return &other != &candidate && is_owned_by(candidate, other, tolerance);
        });
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(),
                                  [](const ContactCandidate& c) { return c.owned; }),
                   candidates.end());
  if (candidates.size() < 2) return;

  std::sort(candidates.begin(), candidates.end(),
            [](const ContactCandidate& a, const ContactCandidate& b) {
              return a.point.distance != b.point.distance ? a.point.distance < b.point.distance
                                                          : a.triangle < b.triangle;
            });
  auto kept = candidates.begin() + 1;
  for (const ContactCandidate& candidate : candidates) {
    if (&candidate == &candidates.front()) continue;
    const bool same_surface =
        std::any_of(candidates.begin(), kept, [&](const ContactCandidate& deeper) {
          return share_node(candidate.nodes, deeper.nodes) &&
                 candidate.point.separation.dot(deeper.point.separation) >
                     merge_cosine_ * candidate.point.distance * deeper.point.distance;
        });
    if (!same_surface) *kept++ = candidate;
  }
  candidates.erase(kept, candidates.end());
}

}  // namespace furrow
