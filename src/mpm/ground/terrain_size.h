// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Size of a terrain, from its parameters alone.

#include <string>

#include "furrow/core/communicator.h"
#include "furrow/mpm/ground/terrain_parameters.h"

namespace furrow {

/// Size of the whole terrain. Real numbers, because far too large ones must be reported as well.
struct TerrainSize {
  double cells = 0.0;
  double particles = 0.0;
};
TerrainSize size_of(const TerrainParameters& parameters);

/// Compares what the ranks of a machine will need with what it has, before anything is made.
/// Collective.
/// @param where names the terrain in the error
/// @throws InputError with the estimate when that is too much
void check_memory(const TerrainParameters& parameters, const Communicator& ranks,
                  const std::string& where);

}  // namespace furrow
