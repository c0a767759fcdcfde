// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The triangles of a body: the only data that solvers exchange.

#include <string>
#include <utility>
#include <vector>

#include "furrow/core/types.h"

namespace furrow {

/// A triangulated surface with nodal position, velocity and force; SI units; replicated on every
/// rank. A force at a point of a triangle is added to f with the barycentric weights of the point,
/// which conserves force and moment (theory: grains, eq. 4).
struct Surface {
  std::vector<Vector3i> triangles;  ///< node indices, outward by the right-hand rule
  Matrix3X x;                       ///< [m]   3 x nodes
  Matrix3X v;                       ///< [m/s] 3 x nodes
  /// [N]   3 x nodes, forces of others on this body since the last clear_forces()
  Matrix3X f;

  std::size_t node_count() const { return static_cast<std::size_t>(x.cols()); }
  std::size_t triangle_count() const { return triangles.size(); }

  void resize(std::size_t nodes);  ///< all three arrays, zeroed
  void clear_forces() { f.setZero(); }

  Vector3 total_force() const;                       ///< [N]
  Vector3 total_moment(const Vector3& about) const;  ///< [N m]
  Vector3 area_vector(std::size_t triangle) const;   ///< outward, length = area [m^2]
  VectorX node_areas() const;                        ///< [m^2] a third of its triangles each
  double total_area() const;                         ///< [m^2]
  double enclosed_volume() const;                    ///< [m^3] of a closed surface
  /// [rad] the sharpest corner of all triangles: how near to a sliver
  double minimum_angle() const;
  std::pair<Vector3, Vector3> bounds() const;  ///< lowest and highest corner

  /// True if every edge is shared by exactly two triangles that run along it in opposite
  /// directions.
  bool is_closed() const;
  /// @throws StateError naming body and node when a position or velocity is not finite
  void check_finite(const std::string& body) const;
};

}  // namespace furrow
