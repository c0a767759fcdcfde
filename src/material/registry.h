// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The laws of a program, and the creation of a material from its keys.
///
/// A law of this library is one row of models/CMakeLists.txt. A program with further laws passes a
/// list, which usually begins with material_models().

#include <memory>
#include <string>
#include <vector>

#include "furrow/material/material_model.h"

namespace furrow {

using MaterialModels = std::vector<MaterialModel>;

/// The laws of this library, in the order of models/CMakeLists.txt.
const MaterialModels& material_models();
/// @throws InputError listing the names
const MaterialModel& find_material_model(const std::string& name,
                                         const MaterialModels& models = material_models());

/// Checks the entries of every section against its schema. @throws InputError
MaterialOptions read_sections(const MaterialModel& model, const MaterialSections& sections);
/// Sorts a flat list into sections: "E 1e6 nu 0.3 hardening table ...". A section's name as a key
/// chooses its type; "section.key" names a key that two sections share. @throws InputError for an
/// unknown or ambiguous key
MaterialSections to_sections(const MaterialModel& model, const std::vector<Entry>& flat);

/// Creates a material from nested sections. @throws InputError
std::unique_ptr<Material> make_material(const MaterialModel& model,
                                        const MaterialSections& sections);
std::unique_ptr<Material> make_material(const std::string& name, const MaterialSections& sections,
                                        const MaterialModels& models = material_models());
/// Creates a material from a flat list of keys. @throws InputError
std::unique_ptr<Material> make_material(const MaterialModel& model, const std::vector<Entry>& flat);
std::unique_ptr<Material> make_material(const std::string& name, const std::vector<Entry>& flat,
                                        const MaterialModels& models = material_models());

}  // namespace furrow
