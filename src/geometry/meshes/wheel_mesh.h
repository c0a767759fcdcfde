// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The closed triangulation of a rigid wheel.

#include <string>

#include "furrow/geometry/surface.h"
#include "furrow/geometry/meshes/wheel_geometry.h"

namespace furrow {

/// Triangulates a wheel: closed, outward, every edge shared by two triangles, no sliver.
///
/// The polygon of nodes has the area of the true circle, so the wheel displaces the true volume.
/// Nodes lie outside of the circle by (2 pi / segments)^2/12 of the radius, facet middles inside by
/// half of that. In the meridian plane the nodes lie on the arc of the shoulder.
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
