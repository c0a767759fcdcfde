// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/inputs/input_kind.h"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

struct Kind {
  InputKind kind;
  std::string name;
  std::vector<std::string> sections;  ///< sections of this kind of file alone
  std::string use;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {InputKind::material,
       "a material file (sections law, elasticity, ...)",
       {"law", "elasticity", "hardening", "base"},
       "name it as 'material' in a scene or in a point file"},
      {InputKind::tyre,
       "a tyre file (sections tyre, tread, sidewall)",
       {"tread", "sidewall"},
       "furrow-tyre, furrow-sidewall and fix tyre/darnell read it"},
      {InputKind::brick_tyre,
       "a tyre file with a tread of bricks (sections tyre, carcass, cap, voids)",
       {"carcass", "cap", "voids"},
       "furrow-tyre and fix tyre/brick read it"},
      {InputKind::point_run,
       "a point file with a path to drive (material, path)",
       {"path"},
       "furrow-point run reads it"},
      {InputKind::point_fit,
       "a point file with curves to fit (material, parameters, curves)",
       {"parameters", "curves"},
       "furrow-point fit reads it"}};
  return all;
}

/// The first of the kind's sections that a file has, or null.
const std::string* section_of(const YamlTree& file, const Kind& kind) {
  for (const std::string& section : kind.sections)
    if (file.find(section)) return &section;
  return nullptr;
}

}  // namespace

bool is_kind(const YamlTree& file, InputKind kind) {
  return section_of(file, kinds()[static_cast<std::size_t>(kind)]) != nullptr;
}

void check_kind(const YamlTree& file, InputKind expected) {
  if (is_kind(file, expected)) return;
  const Kind& wanted = kinds()[static_cast<std::size_t>(expected)];
  for (const Kind& other : kinds())
    if (const std::string* section = section_of(file, other))
      throw InputError(file.origin,
                       fmt::format("has the section '{}': it looks like {}", *section, other.name),
                       wanted.name, other.use);
}

}  // namespace furrow
