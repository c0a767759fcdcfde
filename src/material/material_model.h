// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Declaration of a law: name, meaning, keys by section, creation, examples.

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "furrow/core/options/options.h"
#include "furrow/material/material.h"

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

/// Entries of a file by section; `type` is one of the entries.
using MaterialSections = std::map<std::string, std::vector<Entry>>;

/// A law that files select by name. Its first section is "law" with the density and the keys of the
/// law alone; further sections are shared parts (elasticity_section(), hardening_section()).
struct MaterialModel {
  std::string name;     ///< "drucker_prager_cap"
  std::string meaning;  ///< one line
  std::vector<SectionSchema> sections;
  std::function<std::unique_ptr<Material>(const MaterialOptions&)> create;
  /// Warnings about values that are allowed but unusual together, a sentence each; may be empty.
  std::function<std::vector<std::string>(const MaterialOptions&)> warnings;
  /// Parameters that the conformance suite is run with (src/testing/material_conformance.h), each a
  /// flat list of keys: "density 1600 elasticity linear E 5e6 nu 0.2". One for each branch of the
  /// code that the parameters select.
  std::vector<std::string> examples;
};

/// The section "law" of a law whose keys are these.
SectionSchema law_section(const Schema& schema);

}  // namespace furrow
