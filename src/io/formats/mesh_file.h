// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Mesh files of solids: STL (ASCII or binary), Wavefront OBJ and VTP of VTK.

#include <string>
#include <vector>

#include "furrow/geometry/meshes/solid_mesh.h"

namespace furrow {

/// Corners of the facets as a file has them.
struct MeshFacets {
  std::vector<Vector3> points;
  std::vector<Vector3i> triangles;  ///< numbers of points
  std::vector<int> facets;          ///< of each triangle, from 1

  /// Divides a polygon from its first corner. @param facet  its number
  void add_polygon(const std::vector<int>& corners, int facet);
};

/// Points at one place become one node. @param path names the mesh in errors
/// @throws InputError for no facets, or too many
SolidMesh mesh_of_facets(const std::string& path, const MeshFacets& read);

/// Coordinates are those of the file. Nodes at one place become one node. Polygons of an OBJ file
/// are divided from their first corner; normals, textures and groups are ignored.
/// @param path ends in .stl, .obj or .vtp
/// @throws InputError with file, line or facet, and what is allowed
SolidMesh read_mesh_file(const std::string& path);

}  // namespace furrow
