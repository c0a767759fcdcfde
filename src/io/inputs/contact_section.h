// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The section `contact` of material files and soil cards:
///
///   contact:                       # or the path of a file that has what follows
///     steel:                       # material of the body
///       friction: 0.4
///       friction_range: [0.3, 0.45]
///       slip_length: 0.009         # [m]
///       slip_length_range: [0.006, 0.012]
///       shear_limit: 25e3            # [Pa], optional: adhesion of clay
///       shear_limit_range: [15e3, 30e3]
///       label: estimated           # measured, estimated or assumed
///       source: where both come from

#include <string>

#include "furrow/io/formats/yaml_tree.h"
#include "furrow/material/ground_contact.h"

namespace furrow {

/// Replaces the path in a section `contact` of this file by the content of that file.
/// @throws InputError, also where that file is absent
void insert_contact_file(YamlTree& file, const std::string& path);
/// Contact of a file after insert_contact_file(); empty without a section. @throws InputError
GroundContact contact_of(const YamlTree& file);
/// Contact from a file that holds the content of a section `contact`. @throws InputError
GroundContact read_contact_file(const std::string& path);

}  // namespace furrow
