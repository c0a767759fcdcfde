// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The keyword `patches`: soils side by side on one ground.

#include <string>
#include <vector>

#include "furrow/core/options/options.h"

namespace furrow {

/// Soil of a patch, which begins at a place.
struct PatchInput {
  double begin = 0.0;  ///< [m] on the axis
  std::string soil;    ///< name in the line
};

/// Patches in the order of their places, along one axis.
struct PatchesInput {
  int axis = 0;  ///< 0: along x, 1: across, along y
  std::vector<PatchInput> list;
};

/// @param soil  what stands behind a place
void declare_patches(Schema& schema, const std::string& soil);
/// Reads patches such as "along:0.5:soft.yaml;along:1.5:firm.yaml". @throws InputError
PatchesInput read_patches(const Options& options);

}  // namespace furrow
