// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Continuum ground from the keys of a script line: lengths, cells, faces, and the files of its
/// materials.

#include <optional>

#include "furrow/core/options/options.h"
#include "furrow/mpm/ground/ground_under_wheel.h"
#include "furrow/mpm/ground/terrain_parameters.h"

namespace furrow {

/// The keys of continuum ground. @param subject names the owner in errors
/// @param size  where the ground need not say its own
Schema terrain_schema(const std::string& subject = "continuum ground",
                      const std::optional<GroundSize>& size = {});
/// Reads the material files and lays out the grid. @throws InputError
/// @param folder from which relative paths of material files are found
TerrainParameters read_terrain(const Options& options, const std::string& folder = "");

}  // namespace furrow
