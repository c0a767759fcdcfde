// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Contacts of a sphere with a bending surface: closest points on triangles, and the choice among
/// them.

#include <algorithm>
#include <cmath>
#include <vector>

#include "furrow/core/types.h"

namespace furrow {

/// The point of a triangle that is closest to a given point.
struct ClosestPoint {
  /// sums to one; exactly zero for the nodes that the feature does not contain
  Vector3 barycentric;
  Vector3 separation;  ///< from the closest point to the given point [m]
  double distance;     ///< |separation| [m]

  /// Number of nodes that carry the feature: 1 corner, 2 edge, 3 face.
  int feature_nodes() const {
    return (barycentric[0] > 0.0) + (barycentric[1] > 0.0) + (barycentric[2] > 0.0);
  }
};

/// Closest point of the triangle (a, b, c) to p, for triangles of any shape.
/// Walks through the Voronoi regions of corners and edges (C. Ericson, Real-Time Collision
/// Detection, 2005, sec. 5.1.5).
ClosestPoint closest_point_on_triangle(const Vector3& p, const Vector3& a, const Vector3& b,
                                       const Vector3& c);

/// One triangle within reach of a sphere: a candidate for a contact.
struct ContactCandidate {
  ClosestPoint point;
  int triangle;        ///< global triangle number
  Vector3i nodes;      ///< its global nodes
  int tag;             ///< mark by which the caller finds the triangle again
  bool owned = false;  ///< by a closer triangle; set by the selection
};

/// Decides which candidates of one sphere are contacts:
///  1. an edge or corner is no contact if a triangle that contains it has a closer point; if
///     several triangles report it at equal distance, it counts once;
///  2. of two contacts on triangles that share a node and whose normals differ by less than the
///     merge angle, only the deeper one remains: the facets represent one smooth surface. A
///     sharper valley keeps both contacts.
/// The decision uses the present shape only, so the surface may bend freely.
class ContactSelection {
 public:
  explicit ContactSelection(double merge_angle = radians(20.0))
      : merge_cosine_(std::cos(merge_angle)) {}

  /// Keeps the contacts, deepest first, and removes the others. @param radius of the sphere [m],
  /// the scale of round-off
  void select(std::vector<ContactCandidate>& candidates, double radius) const;

 private:
  double merge_cosine_;
};

}  // namespace furrow
