// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/material_model.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "furrow/core/error.h"

namespace furrow {

SectionSchema law_section(const Schema& schema) { return {"law", {{"", "", schema}}}; }

const SectionChoice& SectionSchema::choice(const std::string& type) const {
  std::vector<std::string> types;
  for (const SectionChoice& candidate : choices) {
    if (candidate.type == type) return candidate;
    types.push_back(candidate.type);
  }
  if (choices.size() == 1)
    throw InputError(fmt::format("section '{}'", name), fmt::format("has a type '{}'", type),
                     "no key 'type' in this section");
  throw InputError(fmt::format("section '{}', keyword 'type'", name), fmt::format("is '{}'", type),
                   fmt::format("one of: {}", fmt::join(types, ", ")));
}

}  // namespace furrow
