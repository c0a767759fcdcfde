// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The mesh of a tyre of shells and bricks.

#include <string>
#include <vector>

#include "furrow/shell/shell4.h"
#include "furrow/solid/brick8.h"
#include "furrow/tyre/brick/brick_tyre_parameters.h"
#include "furrow/tyre/tread_grid.h"

namespace furrow {

/// Nodes of the carcass come first: section after section, from the lowest point towards +x, each
/// from the bead at -y (half: from the mid-plane) to the bead at +y. Bricks share them, so the
/// tread is tied to the carcass without constraints.
struct BrickTyreMesh {
  Matrix3X x;                                    ///< [m] about the axle centre, stress-free
  std::vector<std::vector<Shell4::Quad>> quads;  ///< of each zone
  std::vector<Brick8::Hexahedron> bricks;
  std::vector<int> beads;
  std::vector<int> in_symmetry_plane;  ///< of a half model
  int carcass_nodes = 0;
  int stations = 0;   ///< carcass nodes of a section
  int tread_end = 0;  ///< station at which the tread ends on the side of +y

  /// Nodes of the outside; those of the tread come first, in the order of the grid.
  TreadGrid grid;
  std::vector<int> surface_nodes;
  std::vector<Vector3i> triangles;  ///< of surface nodes
  double tread_area = 0.0;          ///< [m^2] of the whole tyre, voids included
};

/// Sections have equal angles. Across the tyre, elements are at most brick_tyre_aspect times as
/// long as round the crown; zones and voids end at nodes.
/// @param sections round the tyre
/// @throws InputError for voids whose pitch does not fit the sections
BrickTyreMesh make_brick_tyre_mesh(const BrickTyreParameters& tyre, int sections, bool half,
                                   const std::string& where = "tyre");

constexpr double brick_tyre_aspect = 0.45;

}  // namespace furrow
