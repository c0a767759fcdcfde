// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Heightmaps: ESRI ASCII grids, and text with x y z of the points of a regular grid in any order.

#include <string>

#include "geometry/ground_relief.h"

namespace furrow {

/// @param origin  x y z in the file of the place that becomes x = y = z = 0 [m]
/// @throws InputError with file and line: not a grid, a point missing or without a height, a
/// GeoTIFF
Heightmap read_heightmap(const std::string& path, const Vector3& origin = Vector3::Zero());

/// The relief of a line whose keys declare_relief() declared.
/// @param folder from which the relative path of the heightmap is found
GroundRelief read_relief(const Options& options, const std::string& folder);

}  // namespace furrow
