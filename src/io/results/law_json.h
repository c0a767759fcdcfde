// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Laws, keys and material files as JSON, for other programs.

#include <string>
#include <vector>

#include "furrow/core/options/options.h"
#include "furrow/io/inputs/material_file.h"

namespace furrow {

/// Keys of schemas by subject: kind, unit, bounds, choices, meaning, default, whether a value is
/// required. Bounds that are infinite are absent.
std::string schemas_json(const std::vector<Schema>& schemas);

/// Values that soils and snow have, by key.
std::string usual_ranges_json();

/// Laws by name: meaning, and for each section the keys of each type.
std::string laws_json(const MaterialModels& models);

/// A material file with its bases: title, law, effective values by section, and the elastic
/// constants of a point under a pressure [Pa].
std::string material_json(const MaterialFile& file, double pressure);

}  // namespace furrow
