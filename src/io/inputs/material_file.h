// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Material files (inputs/materials/*.yaml): a law and its values, read by the keys that the law
/// declares.
///
///   title: McCormick Ranch sand           # optional
///   law:
///     type: drucker_prager_cap            # a name of furrow-point laws
///     density: 1900                       # the keys of the law
///   elasticity: { type: linear, ... }     # other sections of the law, with a `type` where
///   hardening: { type: table, ... }       # there are several
///   contact: contact/sand.yaml            # optional (contact_section.h)
///   cone_index: 131e3                     # optional [Pa], mean of the first 15 cm
///
/// A variant names another file and gives what differs: `base: fresh_snow.yaml` (in the same
/// folder). A section that is of another type than the base's replaces it whole. The cone index of
/// the base is not that of the variant.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "furrow/io/formats/yaml_tree.h"
#include "furrow/material/ground_contact.h"
#include "furrow/material/material.h"
#include "furrow/material/registry.h"

namespace furrow {

/// Content of a material file. All values have passed the schemas and checks of the law.
struct MaterialFile {
  std::string path;
  std::string title;  ///< the file's, or its name without folder and ending
  MaterialModel model;
  MaterialSections sections;  ///< as given
  MaterialOptions options;    ///< the same values as the law takes them, defaults included
  GroundContact contact;
  std::optional<double> cone_index;   ///< [Pa]
  std::vector<std::string> warnings;  ///< unusual values, a sentence each, to be shown

  std::unique_ptr<Material> make() const { return model.create(options); }
};

/// @throws InputError naming file, line and key, what is allowed and what to do
MaterialFile read_material_file(const std::string& path,
                                const MaterialModels& models = material_models());
/// The material of a file. @throws InputError
std::unique_ptr<Material> load_material(const std::string& path,
                                        const MaterialModels& models = material_models());

/// The effective values, defaults included, with unit and meaning as comments: a material file that
/// gives the same law.
std::string material_file_text(const std::string& title, const MaterialModel& model,
                               const MaterialOptions& options);

}  // namespace furrow
