// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The table of constitutive laws: names, meanings, declared options, creation. A new law adds one
/// row (registry.cpp).

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/options.h"
#include "material/material.h"

namespace furrow {

/// One way to fill a section, chosen by the key `type`: "elasticity" with type "linear" or
/// "porous".
struct SectionChoice {
  std::string type;     ///< "linear"; empty when the section has one form and no key `type`
  std::string meaning;  ///< one line
  Schema schema;        ///< subject "elasticity linear"; does not contain `type`
};

/// A group of keys of a material file.
struct SectionSchema {
  std::string name;                    ///< "law", "elasticity", "hardening"
  std::vector<SectionChoice> choices;  ///< the first is taken when `type` is not given

  /// @throws InputError listing the types
  const SectionChoice& choice(const std::string& type) const;
};

/// The values of a section that passed their schema.
struct SectionOptions {
  std::string type;
  Options options;
};
using MaterialOptions = std::map<std::string, SectionOptions>;  ///< by section name

/// What a file gives: entries by section; `type` is an entry among the others. The section "law"
/// holds density and yield keys.
using MaterialSections = std::map<std::string, std::vector<Entry>>;

/// One row of the table.
struct MaterialModel {
  std::string name;     ///< "drucker_prager_cap"
  std::string meaning;  ///< one line
  std::vector<SectionSchema> sections;
  std::function<std::unique_ptr<Material>(const MaterialOptions&)> create;
};

/// All laws, in the order of the page that lists them.
const std::vector<MaterialModel>& material_models();
/// @throws InputError listing the names
const MaterialModel& find_material_model(const std::string& name);

/// Checks the entries of every section against its schema. @throws InputError
MaterialOptions read_sections(const MaterialModel& law, const MaterialSections& sections);
/// Sorts a flat list into sections: "E 1e6 nu 0.3 hardening table ...". A section's name as a key
/// chooses its type; "section.key" names a key that two sections share. @throws InputError for an
/// unknown or ambiguous key
MaterialSections to_sections(const MaterialModel& law, const std::vector<Entry>& flat);

/// Creates a law from nested sections. @throws InputError
std::unique_ptr<Material> make_material(const std::string& name, const MaterialSections& sections);
/// Creates a law from a flat list of keys. @throws InputError
std::unique_ptr<Material> make_material(const std::string& name, const std::vector<Entry>& flat);

}  // namespace furrow
