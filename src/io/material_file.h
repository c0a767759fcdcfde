// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Material files (inputs/materials/*.yaml): a law and its values, read through the law's own
/// declaration of keys.
///
///   title: McCormick Ranch sand           # optional
///   law:
///     type: drucker_prager_cap            # a name of furrow-point laws
///     density: 1900                       # the keys of the law
///   hardening: { type: table, ... }       # the law's other sections, each with its `type` where
///   it has several elasticity: { type: linear, ... }
///
/// A variant names another file and gives what differs: `base: fresh_snow.yaml` (beside this file).
/// A section that is of another type than the base's replaces it whole.

#include <memory>
#include <string>

#include "io/yaml_tree.h"
#include "material/material.h"
#include "material/registry.h"

namespace furrow {

/// What a material file says. All values have passed the law's schemas and the law's own checks.
struct MaterialFile {
  std::string path;
  std::string title;  ///< the file's, or its name without folder and ending
  std::string material;
  MaterialSections sections;

  std::unique_ptr<Material> make() const { return make_material(material, sections); }
};

/// @throws InputError naming file, line and key, what is allowed and what to do
MaterialFile read_material_file(const std::string& path);
/// The law of a material file. @throws InputError
std::unique_ptr<Material> load_material(const std::string& path);

/// The effective values, defaults included, with unit and meaning as comments: a material file that
/// gives the same law.
/// @throws InputError when the sections do not pass
std::string material_file_text(const std::string& title, const std::string& material,
                               const MaterialSections& sections);

}  // namespace furrow
