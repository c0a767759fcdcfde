// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Mesh files of solids: STL (ASCII or binary) and Wavefront OBJ.

#include <string>

#include "geometry/solid_mesh.h"

namespace furrow {

/// Coordinates are those of the file. Nodes at one place become one node. Polygons of an OBJ file
/// are divided from their first corner; normals, textures and groups are ignored.
/// @param path ends in .stl or .obj
/// @throws InputError with file, line or facet, and what is allowed
SolidMesh read_mesh_file(const std::string& path);

}  // namespace furrow
