// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Everything that makes a piece of continuum ground.

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "material/material.h"
#include "mpm/axis.h"
#include "mpm/boundary.h"

namespace furrow {

/// Layers lie on one another, the first on top; the lowest reaches the base whatever its thickness.
struct TerrainLayer {
  std::shared_ptr<const Material> material;
  double thickness = 0.0;  ///< [m]
};

struct TerrainParameters {
  AxisLayout x, y, z;    ///< of the grid; z reaches above the surface for what is pushed up
  double surface = 0.0;  ///< z of the undisturbed ground [m]; a knot of the z axis
  std::vector<TerrainLayer> layers;
  std::array<BoundaryKind, face_count> faces = {BoundaryKind::smooth, BoundaryKind::smooth,
                                                BoundaryKind::smooth, BoundaryKind::smooth,
                                                BoundaryKind::rough,  BoundaryKind::free};
  std::array<int, 3> particles_per_cell = {2, 2, 2};  ///< in each direction
  Vector3 gravity = {0.0, 0.0, -standard_gravity};    ///< [m/s^2]
  /// the weight of the ground is carried from the start, sideways as in confined compression
  bool initial_stress = true;
  double cfl = 0.4;  ///< step over (shortest cell)/(wave speed + speed of the ground)
  /// most steps for which the grid moves with the ground before particles are mapped to it anew
  int remap_interval = 16;
  bool sheet = false;   ///< carries triangles on its upper face, for grains
  bool window = false;  ///< the ground moves along x with what follow() names
};

}  // namespace furrow
