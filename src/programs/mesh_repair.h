// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Repairs of triangle meshes by CGAL.

#include <functional>
#include <string>
#include <vector>

#include "furrow/geometry/surface.h"

namespace furrow {

/// Lengths in the unit of the mesh.
struct RepairLimits {
  double merge = 0.0;   ///< corners nearer than this become one
  double hole = 0.0;    ///< holes up to this size are closed
  double detail = 0.0;  ///< gaps smaller than this are bridged by a wrap
};

/// A surface and how it came about, a line for each step.
struct RepairedMesh {
  Surface surface;
  std::vector<std::string> changes;
};

/// Tries repairs, the one that changes least first: cleaned facets and closed holes; parts united;
/// new facets without sharp corners; a wrap (C. Portaneri et al., ACM Trans. Graph. 41(4), 2022).
/// @param accept  whether a surface is good enough
/// @return the first accepted one @throws StateError if none is
RepairedMesh repair_mesh(const Surface& mesh, const RepairLimits& limits,
                         const std::function<bool(const Surface&)>& accept);

/// Largest distance of the nodes of a surface from the triangles of another.
double largest_distance(const Surface& nodes_of, const Surface& from);

}  // namespace furrow
