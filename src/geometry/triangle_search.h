// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Triangles of a surface near a point, by bins over space; rebuilt when the surface has moved far
/// enough.

#include <vector>

#include "furrow/geometry/surface.h"

namespace furrow {

class TriangleSearch {
 public:
  /// Assigns every triangle to all bins within `reach` [m] of it. Bins cover the part of the
  /// surface inside [lower, upper].
  TriangleSearch(const Surface& surface, double reach, const Vector3& lower, const Vector3& upper);

  const Vector3& lower() const { return lower_; }  ///< of the region that has bins
  const Vector3& upper() const { return upper_; }
  bool covers(const Vector3& point) const {
    return (point.array() >= lower_.array()).all() && (point.array() <= upper_.array()).all();
  }
  /// Triangles that may be within reach of a point of the region, as a range of triangle numbers;
  /// none outside.
  std::pair<const int*, const int*> near(const Vector3& point) const;

 private:
  std::size_t bin(const Vector3& point) const;

  Vector3 lower_, upper_;
  double per_length_ = 0.0;
  Vector3i count_ = Vector3i::Zero();
  std::vector<std::size_t> start_;
  std::vector<int> triangles_;
};

/// Triangles that meet at each node.
class NodeTriangles {
 public:
  explicit NodeTriangles(const Surface& surface);
  /// A direction to the outside at the feature that a closest point lies on: the triangle's normal,
  /// the sum of the two normals at an edge, the sum weighted by angles at a corner. Its sign tells
  /// inside from outside of a closed surface at every feature (J. A. Baerentzen, H. Aanaes, IEEE
  /// TVCG 11, 2005). Not of unit length.
  Vector3 outward(const Surface& surface, std::size_t triangle, const Vector3& barycentric) const;
  /// Calls visit(unit normal) for every triangle that has the feature: the edge or corner of a
  /// closest point.
  template <class Visit>
  void for_normals(const Surface& surface, std::size_t triangle, const Vector3& barycentric,
                   Visit visit) const {
    const Vector3i& own = surface.triangles[triangle];
    int carrier[3] = {-1, -1, -1}, found = 0;
    for (int c = 0; c < 3; ++c)
      if (barycentric[c] > 0.0) carrier[found++] = own[c];
    const auto node = static_cast<std::size_t>(carrier[0]);
    for (std::size_t n = start_[node]; n < start_[node + 1]; ++n) {
      const auto t = static_cast<std::size_t>(triangles_[n]);
      if (found < 2 || (surface.triangles[t].array() == carrier[1]).any())
        visit(Vector3(surface.area_vector(t).normalized()));
    }
  }

 private:
  std::vector<std::size_t> start_;
  std::vector<int> triangles_;
};

/// True if a point is inside a closed surface, by counting the crossings of a ray. Visits every
/// triangle.
bool encloses(const Surface& surface, const Vector3& point);

}  // namespace furrow
