// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Heightmaps: ESRI ASCII grids, text with x y z of points in any order, and pictures.

#include <optional>
#include <string>

#include "furrow/geometry/ground_relief.h"

namespace furrow {

/// Sizes of a picture [m]: length along x, width along y, height of black and of white. Its middle
/// is x = y = 0 of the file, its upper edge the largest y.
using PictureSize = Eigen::Vector4d;

/// A text may have a line of headings, of which x, y and z count, further columns and decimal
/// commas. Points that are on no regular grid are resampled on one: a plane is fitted to the points
/// around each node, and the note of the map has the error.
/// @param origin  x y z in the file of the place that becomes x = y = z = 0 [m]
/// @throws InputError with file and line: a point missing or without a height, a GeoTIFF
Heightmap read_heightmap(const std::string& path, const Vector3& origin = Vector3::Zero(),
                         const std::optional<PictureSize>& picture = {});

/// The relief of a line whose keys declare_relief() declared.
/// @param folder from which the relative path of the heightmap is found
GroundRelief read_relief(const Options& options, const std::string& folder);

}  // namespace furrow
