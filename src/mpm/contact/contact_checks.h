// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Refuses positions of a surface and a terrain that no contact can start from.

#include <vector>

#include "furrow/geometry/surface.h"
#include "furrow/mpm/grid/grid.h"
#include "furrow/mpm/particles/particle_group.h"

namespace furrow {

/// @throws StateError when the middle of a surface is beyond the sides of the grid
void check_within_terrain(const Surface& surface, const Grid& grid);
/// @param groups  this rank's particles
/// @throws StateError when a closed surface encloses a particle
void check_no_overlap(const Surface& surface, const std::vector<ParticleGroup>& groups);

}  // namespace furrow
