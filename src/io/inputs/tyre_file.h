// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Tyre files (inputs/tyres/*.yaml): sections tyre, tread and sidewall with the keys of
/// tyre_schemas().
///
///   title: P235/75 R15                                  # optional
///   tyre:     {pressure: 241e3, bead_radius: 0.208, bead_spacing: 0.165}
///   tread:    {radius: 0.3475, half_width: 0.0785, thickness: 1.11e-3, ...}
///   sidewall: {length: 0.161, bending: [1.5, ...], curvature: [6.76, ...], rim_angle: 23, ...}

#include <string>

#include "furrow/io/inputs/tyre_sections.h"
#include "furrow/tyre/tyre_parameters.h"

namespace furrow {

/// The sections of a tyre file with their keys; angles in degrees.
TyreSchemas tyre_schemas();

/// All values have passed the schemas and check().
/// @throws InputError naming file, line and key, what is allowed and what to do
TyreParameters read_tyre_file(const std::string& path);

/// A tyre file that reads back as the same tyre, with unit and meaning as comments.
std::string tyre_file_text(const TyreParameters& tyre);

}  // namespace furrow
