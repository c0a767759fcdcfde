// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The shape of a flat plate, and its closed triangulation.

#include <string>

#include "geometry/surface.h"

namespace furrow {

enum class PlateShape { circle, square };

/// A plate that lies level; its lower face meets the ground.
struct PlateGeometry {
  PlateShape shape = PlateShape::circle;
  double size = 0.0;       ///< [m] diameter or side
  double thickness = 0.0;  ///< [m]
  int elements = 20;       ///< across the plate; even for a circle

  double area() const;  ///< [m^2] of the lower face
};

/// Triangulates a plate: closed, outward; centre of the lower face at the origin, the plate above
/// it. The edge of a circle is a regular polygon of the circle's area, so mean pressures are exact.
/// @param where names the plate in errors
/// @throws InputError for a shape that cannot be, or whose elements would be slivers
Surface make_plate_mesh(const PlateGeometry& geometry, const std::string& where = "plate");

}  // namespace furrow
