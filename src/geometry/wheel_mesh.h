// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The shape of a rigid wheel, and its closed triangulation.

#include <string>

#include "geometry/surface.h"

namespace furrow {

/// Straight bars of rectangular section across the flat tread; none when number is 0.
struct Grousers {
  int number = 0;          ///< equally spaced around
  double height = 0.0;     ///< [m] above the tread
  double thickness = 0.0;  ///< [m] square to the bar, the same from root to tip
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

/// Triangulates a wheel: closed, outward, every edge shared by two triangles, no sliver.
///
/// Nodes lie slightly outside of the true circle, by the one factor that makes the area of the
/// polygon equal to that of the circle: nodes (2 pi / segments)^2/12 of the radius outside, facet
/// middles half as much inside. The wheel so displaces the volume of the true one, and its mean
/// radius is right; nodes on the circle would make every wheel smaller. In the meridian plane the
/// nodes lie on the shoulder's arc.
///
/// Grousers stand on the tread grid, whose lines are laid along the edges of the bars (sheared by
/// the skew angle); the tread below a bar is left out. No element is longer than four times the
/// smallest of thickness, height and gap.
///
/// @param where names the wheel in errors: "fix wheel/rigid"
/// @throws InputError for a shape that cannot be, or whose elements would be slivers (a corner
/// below minimum_mesh_angle)
Surface make_wheel_mesh(const WheelGeometry& geometry, const std::string& where = "wheel");

constexpr double minimum_mesh_angle = radians(5.0);

}  // namespace furrow
