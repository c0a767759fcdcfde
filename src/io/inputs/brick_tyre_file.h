// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Files of tyres of shells and bricks (inputs/tyres/*_smooth.yaml, ...): sections tyre, carcass,
/// cap and, where the tread has any, voids, with the keys of brick_tyre_schemas().
///
///   title: P235/75 R15, smooth
///   tyre:    {pressure: 241e3}
///   carcass: {axial: [0, ...], radius: [0.3475, ...], zone_end: [0.079, ...], ...}
///   cap:     {at: [0, ...], thickness: [0.021, ..., 0], C10: 1.11e6, density: 814.6}
///   voids:   {from: [0.010, ...], to: [0.027, ...], depth: [5.1e-3, ...]}

#include <string>

#include "furrow/io/inputs/tyre_sections.h"
#include "furrow/tyre/brick/brick_tyre_parameters.h"

namespace furrow {

/// The sections with their keys.
TyreSchemas brick_tyre_schemas();

/// True for a file that has a section of such a tyre. @throws InputError as read_yaml()
bool is_brick_tyre_file(const std::string& path);

/// All values have passed the schemas and check().
/// @throws InputError naming file, line and key, what is allowed and what to do
BrickTyreParameters read_brick_tyre_file(const std::string& path);

/// A file that reads back as the same tyre, with unit and meaning as comments.
std::string brick_tyre_file_text(const BrickTyreParameters& tyre);

}  // namespace furrow
