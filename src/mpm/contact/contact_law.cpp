// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/contact/contact_law.h"

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

/// A row of ContactLaw.
struct Row {
  const char* name;
  const char* meaning;
  ContactLaw (*make)(const ContactParameters&);
};

template <class... Law>
std::vector<Row> rows_of(const std::variant<Law...>*) {
  return {{Law::name, Law::meaning,
           [](const ContactParameters& parameters) -> ContactLaw { return Law(parameters); }}...};
}

std::vector<Row> rows() { return rows_of(static_cast<const ContactLaw*>(nullptr)); }

}  // namespace

std::vector<std::string> contact_law_names() {
  std::vector<std::string> names;
  for (const Row& row : rows()) names.push_back(row.name);
  return names;
}

std::string contact_law_meanings() {
  std::vector<std::string> meanings;
  for (const Row& row : rows()) meanings.push_back(fmt::format("`{}`: {}", row.name, row.meaning));
  return fmt::format("{}", fmt::join(meanings, "; "));
}

ContactLaw make_contact_law(const ContactParameters& parameters, const std::string& where) {
  for (const Row& row : rows())
    if (parameters.enforcement == row.name) return row.make(parameters);
  throw InputError(where, fmt::format("has the enforcement '{}'", parameters.enforcement),
                   fmt::format("{}", fmt::join(contact_law_names(), ", ")));
}

}  // namespace furrow
