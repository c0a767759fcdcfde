// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Thin parts of a closed surface: blades, grousers, lugs and walls, whose two faces lie near each
/// other.
///
/// A triangle belongs to a thin part if the ray from its middle into the body leaves through a
/// triangle that faces the other way, within the largest thickness. Neighbours without a sharp edge
/// between them make a face. A face that is narrower than the part is thick bounds no part: the tip
/// of a grouser. The larger of the two faces of a part stands for it, half the thickness above the
/// middle surface. A part that carries another one, as a rim its grousers, is left out.

#include <array>
#include <vector>

#include "furrow/core/checkpoint.h"
#include "furrow/geometry/surface.h"

namespace furrow {

/// Place of a point with respect to a thin part.
struct PlaceAtPart {
  double distance = 0.0;             ///< from the face that stands for the part [m]
  double height = 0.0;               ///< over the middle surface, or its tangent beyond an end [m]
  bool beside = false;               ///< false beyond an end: tip, free side or open edge
  Vector3 normal = Vector3::Zero();  ///< of the part there
};

class ThinPart {
 public:
  struct Facet {
    Vector3i nodes;
    double half_thickness;            // [m]
    std::array<bool, 3> edge_ends;    // the edge across from the corner ends the part
    std::array<bool, 3> corner_ends;  // the corner lies on such an edge
  };
  std::vector<Facet> facets;
  /// Numbers of the regions of space before and behind the part. Parts that face each other across
  /// a gap have the same region between them.
  std::array<int, 2> region = {0, 1};

  /// @param x  present nodes of the surface [m]
  PlaceAtPart place(const Matrix3X& x, const Vector3& point) const;
  std::pair<Vector3, Vector3> bounds(const Matrix3X& x) const;  ///< [m]
};

/// The thin parts of a surface in its present shape.
/// @param largest_thickness  [m]
/// @param largest_gap  between parts that face each other [m]
/// @param regions  how many numbers there are; both sides of a part differ
std::vector<ThinPart> find_thin_parts(const Surface& surface, double largest_thickness,
                                      double largest_gap, int regions);

/// Saves or restores parts. A surface that has turned gives parts that differ by rounding, and the
/// other one of two equal faces.
void checkpoint_parts(Checkpoint& state, std::vector<ThinPart>& parts);

}  // namespace furrow
