// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/inputs/tyre_sections.h"

#include <filesystem>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

std::string tyre_title(const YamlTree& file, const std::string& path) {
  const YamlTree* title = file.find("title");
  if (title && title->kind != YamlTree::Kind::text)
    throw InputError(fmt::format("{}: keyword 'title'", title->origin), "is not a text", "a text");
  return title ? title->text : std::filesystem::path(path).stem().string();
}

std::string tyre_sections_text(const std::string& title, const TyreSchemas& schemas,
                               const TyreValues& values) {
  std::string text = fmt::format("title: {}\n", quoted(title));
  for (const auto& [section, schema] : schemas) {
    const auto found = values.find(section);
    if (found == values.end()) continue;
    text += fmt::format("{}:\n", section);
    for (const Key& key : schema.keys())
      text += fmt::format("  {}: {}  # {}{}\n", key.name, found->second.at(key.name),
                          key.unit.empty() ? "" : fmt::format("[{}] ", key.unit), key.meaning);
  }
  return text;
}

}  // namespace furrow
