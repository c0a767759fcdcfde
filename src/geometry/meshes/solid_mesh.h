// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The surface of a solid from a file: checks and mass properties.

#include <string>
#include <vector>

#include "furrow/geometry/surface.h"

namespace furrow {

/// Triangles of a file. Nodes at one place are one node.
struct SolidMesh {
  std::string file;  ///< names the mesh in errors
  Surface surface;
  std::vector<int> facets;  ///< number in the file of each triangle, from 1
};

/// Nodes of a file nearer than this are one, and facets thinner than this are degenerate; of the
/// diagonal of the mesh. Coordinates of a binary STL file have an error of 6e-8.
constexpr double solid_mesh_tolerance = 1e-6;

/// Checks that the mesh encloses a solid: no degenerate facet, every edge in two facets that run
/// through it in opposite directions, no facets that meet elsewhere, all facets outwards. A cavity
/// is a shell inside the solid whose facets point into the cavity.
/// @throws InputError with file, facet and remedy of the first fault, and the number of each kind
void check_solid(const SolidMesh& mesh);

/// Mass properties of a solid of unit density with a closed surface.
struct MassProperties {
  double volume = 0.0;                ///< [m^3]
  Vector3 centre = Vector3::Zero();   ///< [m] of mass
  Matrix3 inertia = Matrix3::Zero();  ///< [m^5] about the origin of the coordinates
};

/// Divergence theorem: sums over the tetrahedra of the triangles and one point (B. Mirtich, J.
/// Graphics Tools 1(2), 1996).
MassProperties mass_properties(const Surface& surface);

}  // namespace furrow
