// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A bed of grains as a group of an HDF5 file: /grains/reference and /grains/final of
/// history_file.h.

#include <string>

#include "furrow/io/formats/grains.h"

namespace furrow {

class Hdf5File;

/// Replaces the group. @throws Error
void write_grains(Hdf5File& file, const std::string& group, const Grains& grains,
                  bool with_velocity);
/// @throws Error when the group is missing or no bed of grains
Grains read_grains(const Hdf5File& file, const std::string& group);

}  // namespace furrow
