// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Everything that makes a continuum terrain.

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "furrow/core/options/options.h"
#include "furrow/geometry/ground_relief.h"
#include "furrow/material/ground_contact.h"
#include "furrow/material/material.h"
#include "furrow/mpm/grid/axis.h"
#include "furrow/mpm/grid/block_layout.h"
#include "furrow/mpm/grid/boundary.h"
#include "furrow/mpm/discontinuities/slide_surface.h"

namespace furrow {

/// Layers lie on one another, the first on top; the lowest reaches the base whatever its thickness.
struct TerrainLayer {
  std::shared_ptr<const Material> material;
  double thickness = 0.0;  ///< [m]
  /// The law and its effective keys, as a checkpoint compares them; may be empty.
  std::vector<Entry> description = {};
  std::vector<std::string> warnings = {};  ///< of the reader, to be shown
  std::string name = {};                   ///< name of the material
  GroundContact contact = {};              ///< with bodies
};

/// Ground with other layers from a place on.
struct TerrainPatch {
  double begin = 0.0;           ///< [m] on the axis of the patches
  std::size_t first_layer = 0;  ///< of its layers, which reach to those of the next patch
};

/// A channel along x in the surface, as long as the ground, that grains fill; its middle is that of
/// the y axis.
struct Trough {
  double width = 0.0;  ///< [m]
  double depth = 0.0;  ///< [m]
};

/// Exchange between particles and grid (terrain_step.h, cell_average.h).
struct TransferScheme {
  bool cell_average = true;  ///< of volume change and pressure
  /// share of the residual motion that particles keep while a wave crosses 6.4 cells of the
  /// undisturbed ground, or the fastest particle 1/20 of a cell
  double residual_share = 0.95;
};

struct TerrainParameters {
  AxisLayout x;  ///< of the grid
  AxisLayout y;
  AxisLayout z;                      ///< reaches above the surface, for ground that is pushed up
  double surface = 0.0;              ///< z of the undisturbed surface [m]; a knot of the z axis
  GroundRelief relief = {};          ///< of that surface
  std::vector<TerrainLayer> layers;  ///< of the ground without patches, then of each patch
  int patch_axis = 0;                ///< 0: patches along x, 1: along y
  std::vector<TerrainPatch> patches = {};
  /// kinds in the order of Face: both ends and both sides smooth, a rough base, a free top
  FaceArray<BoundaryKind> boundary = {BoundaryKind::smooth, BoundaryKind::smooth,
                                      BoundaryKind::smooth, BoundaryKind::smooth,
                                      BoundaryKind::rough,  BoundaryKind::free};
  std::array<int, 3> particles_per_cell = {2, 2, 2};  ///< in each direction
  Vector3 gravity = {0.0, 0.0, -standard_gravity};    ///< [m/s^2]
  /// the ground carries its own weight from the start, with the stress of confined compression
  bool initial_stress = true;
  /// [Pa] weight of what lies on the surface, or on the bottom of the trough where there is one, in
  /// the initial stress
  double surcharge = 0.0;
  std::optional<Trough> trough = {};
  double cfl = 0.4;  ///< step over (shortest cell)/(wave speed + speed of the ground)
  /// largest number of steps between two remaps of particles and grid (terrain_step.h)
  int remap_interval = 16;
  TransferScheme scheme = {};
  std::optional<SlideSurface> slide = {};  ///< along which the ground slides on itself
  bool thin_parts = false;                 ///< of bodies divide the ground (divided_ground.h)
  bool surface_mesh = false;               ///< carries triangles on its free surface, for grains
  std::size_t surface_mesh_every = 1;      ///< particles from node to node of these triangles
  bool multirate = false;  ///< true: one step for as many steps of grains as the stable step allows
  /// tolerance of active_ground.h; 0: all of the ground is computed
  double sleep_tolerance = 0.0;
  bool window = false;  ///< moves along x with what ContinuumTerrain::follow() names
  /// parts of its length: with a surface mesh it moves on by one at a time; else 0, by cells
  std::size_t slabs = 0;
  /// how often particles are halved along x on their way to the fine cells (following_axis());
  /// the window then moves on by 2^halvings of these at a time
  int halvings = 0;
  /// blocks of the ranks; without them choose_layout()
  std::optional<BlockLayout> blocks = {};

  /// First and last layer of a patch; of the ground before all patches for 0.
  std::pair<std::size_t, std::size_t> layers_of(std::size_t patch) const {
    return {patch == 0 ? 0 : patches[patch - 1].first_layer,
            (patch < patches.size() ? patches[patch].first_layer : layers.size()) - 1};
  }
  int velocity_fields() const { return thin_parts ? 3 : slide ? 2 : 1; }
};

}  // namespace furrow
