// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Common parts of the files of all tyres: a title, and sections of keys.

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "furrow/core/options/options.h"
#include "furrow/io/formats/yaml_tree.h"

namespace furrow {

using TyreSchemas = std::vector<std::pair<std::string, Schema>>;
/// section -> key -> the value as YAML
using TyreValues = std::map<std::string, std::map<std::string, std::string>>;

/// The title, or without one the name of the file at path. @throws InputError where it is no text
std::string tyre_title(const YamlTree& file, const std::string& path);

/// The text of a file, with unit and meaning as comments. A section without values is left out.
std::string tyre_sections_text(const std::string& title, const TyreSchemas& schemas,
                               const TyreValues& values);

}  // namespace furrow
