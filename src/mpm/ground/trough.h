// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A trough in undisturbed ground: a channel along x, cut into its surface, that grains fill.

#include <cstddef>
#include <string>
#include <vector>

#include "furrow/mpm/grid/axis.h"
#include "furrow/mpm/ground/overburden.h"
#include "furrow/mpm/ground/terrain_parameters.h"

namespace furrow {

/// The particles that a trough leaves out, among those of ground up to its surface. Without a
/// trough: none.
struct TroughPlace {
  std::size_t from_row = 0, to_row = 0;  ///< half-open; rows of particles count along y
  std::size_t levels = 0;                ///< from the surface down

  bool contains(std::size_t row) const { return row >= from_row && row < to_row; }
};

/// @param levels  of the ground beside the trough, from the surface down
/// @param where   names the terrain in errors
/// @throws InputError for a trough whose sides or bottom do not lie between two particles, that is
/// narrower than three cells, whose sides could act on each other through the grid, or that leaves
/// less than two cells of ground beside or below it
TroughPlace place_trough(const TerrainParameters& parameters, const Axis& y,
                         const std::vector<ParticleLevel>& levels, const std::string& where);

}  // namespace furrow
