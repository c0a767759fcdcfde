// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The shape of a rigid wheel.

#include <string>

#include "furrow/core/types.h"

namespace furrow {

/// Straight bars of rectangular section across the flat tread; none when number is 0.
struct Grousers {
  int number = 0;          ///< equally spaced around
  double height = 0.0;     ///< [m] above the tread
  double thickness = 0.0;  ///< [m] normal to the bar, the same from root to tip
  /// [rad] skew against the axle in the tread plane; > 0: the end at +y runs ahead
  double angle = 0.0;
};

/// A cylinder with rounded shoulders: axle along y, centre at the origin.
struct WheelGeometry {
  double diameter = 0.0;      ///< [m] of the tread, without grousers
  double width = 0.0;         ///< [m] from side to side
  double shoulder = 0.0;      ///< [m] radius between tread and side; 0: a sharp edge
  int segments = 64;          ///< facets around
  double element_size = 0.0;  ///< [m] of the elements across; 0: one and a half facets
  Grousers grousers;

  double radius() const { return 0.5 * diameter; }
  double tread_width() const { return width - 2.0 * shoulder; }  ///< [m] of the flat part
  /// Lowest point of the wheel without grousers below its centre [m], for an axle that points along
  /// the unit vector axle.
  double depth_below_centre(const Vector3& axle) const;
};

/// @param where names the wheel in errors: "fix wheel/rigid"
/// @throws InputError for a shape that cannot be
void check(const WheelGeometry& geometry, const std::string& where);

}  // namespace furrow
