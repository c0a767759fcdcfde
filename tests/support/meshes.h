// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Surfaces of solids, and mesh files of them.

#include <fstream>
#include <string>

#include <fmt/format.h>

#include "furrow/geometry/meshes/solid_mesh.h"

namespace furrow::test {

/// Twelve triangles.
inline Surface box(const Vector3& lower, const Vector3& upper) {
  Surface surface;
  surface.resize(8);
  for (int n = 0; n < 8; ++n)
    for (int k = 0; k < 3; ++k) surface.x(k, n) = (n >> k) % 2 == 0 ? lower[k] : upper[k];
  surface.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                       {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return surface;
}

/// Both, as the parts of one mesh.
inline Surface joined(const Surface& one, const Surface& other) {
  Surface surface;
  surface.resize(one.node_count() + other.node_count());
  surface.x << one.x, other.x;
  surface.triangles = one.triangles;
  for (const Vector3i& triangle : other.triangles)
    surface.triangles.push_back(triangle.array() + static_cast<int>(one.node_count()));
  return surface;
}

/// The same surface, seen from the other side.
inline Surface turned(Surface surface) {
  for (Vector3i& triangle : surface.triangles) std::swap(triangle[1], triangle[2]);
  return surface;
}

inline SolidMesh solid(const Surface& surface, const std::string& file = "part.stl") {
  SolidMesh mesh{file, surface, {}};
  for (std::size_t t = 0; t < surface.triangle_count(); ++t)
    mesh.facets.push_back(static_cast<int>(t) + 1);
  return mesh;
}

/// ASCII STL with all digits.
inline void write_stl(const std::string& path, const Surface& surface) {
  std::ofstream file(path);
  file << "solid part\n";
  for (const Vector3i& triangle : surface.triangles) {
    file << "  facet normal 0 0 0\n    outer loop\n";
    for (const int node : triangle)
      file << fmt::format("      vertex {} {} {}\n", surface.x(0, node), surface.x(1, node),
                          surface.x(2, node));
    file << "    endloop\n  endfacet\n";
  }
  file << "endsolid part\n";
}

}  // namespace furrow::test
