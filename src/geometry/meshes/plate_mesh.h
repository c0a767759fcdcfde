// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The shape of a flat plate, and its closed triangulation.

#include <string>

#include "furrow/geometry/surface.h"

namespace furrow {

enum class PlateShape { circle, square, annulus, cone };

/// A plate that lies level; its lower face meets the ground. The cone is that of a penetrometer:
/// its apex points down, and a shaft of smaller diameter stands on its base.
struct PlateGeometry {
  PlateShape shape = PlateShape::circle;
  double size = 0.0;        ///< [m] diameter, side, or diameter of the cone's base
  double thickness = 0.0;   ///< [m] of the edge, or length of the shaft
  int elements = 20;        ///< across the plate; even for a circle
  double inner_size = 0.0;  ///< [m] inner diameter of an annulus
  double angle = 30.0;      ///< [degrees] at the apex of a cone, between opposite sides

  double area() const;  ///< [m^2] of the lower face, or of the cone's base
};

/// Triangulates a plate: closed, outward; centre of the lower face or apex at the origin, the plate
/// above it. Circles are regular polygons of the circle's area, so mean pressures are exact.
/// @param where names the plate in errors
/// @throws InputError for a shape that cannot be, or whose elements would be slivers
Surface make_plate_mesh(const PlateGeometry& geometry, const std::string& where = "plate");

}  // namespace furrow
