// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/styles/style_registry.h"

#include <algorithm>

#include "coupling/liggghts/library_check.h"

namespace furrow::coupling {

namespace {

/// A local static object, which exists before the first row of any source file uses it.
std::vector<Style>& table() {
  static std::vector<Style> rows;
  return rows;
}

}  // namespace

StyleRow::StyleRow(Style style) {
  const auto place = std::upper_bound(
      table().begin(), table().end(), style,
      [](const Style& left, const Style& right) { return left.name < right.name; });
  table().insert(place, std::move(style));
}

const std::vector<Style>& styles() { return table(); }

const Style* find_style(const std::string& name) {
  const auto found = std::find_if(styles().begin(), styles().end(), [&](const Style& style) {
    return style.name == name ||
           std::count(style.former_names.begin(), style.former_names.end(), name);
  });
  return found == styles().end() ? nullptr : &*found;
}

std::string style_names(const std::vector<std::string>& kinds) {
  std::vector<std::string> names;
  for (const std::string& kind : kinds)
    for (const Style& style : styles())
      if (style.kind == kind) names.push_back(style.name);
  std::string text;
  for (std::size_t n = 0; n < names.size(); ++n)
    text += (n == 0 ? "" : n + 1 < names.size() ? ", " : " or ") + names[n];
  return text;
}

void add_styles(LAMMPS_NS::LAMMPS& lammps) {
  with_collective_errors(*lammps.error, [&] { check_library(lammps); });
  for (const Style& style : styles()) {
    if (style.add_model) style.add_model();
    if (style.run_command) add_command(lammps, style.name, style.run_command);
    if (!style.create_fix) continue;
    add_fix_style(lammps, style.name, style.create_fix);
    for (const std::string& former : style.former_names)
      add_fix_style(lammps, former, style.create_fix);
  }
}

}  // namespace furrow::coupling
