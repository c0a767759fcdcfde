// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/inputs/material_file.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "furrow/core/error.h"
#include "furrow/core/options/nearest_word.h"
#include "furrow/io/inputs/contact_section.h"
#include "furrow/io/inputs/input_kind.h"
#include "furrow/material/plausibility.h"

namespace furrow {

namespace {

std::vector<std::string> section_names(const MaterialModel& model) {
  std::vector<std::string> names;
  for (const SectionSchema& section : model.sections) names.push_back(section.name);
  return names;
}

/// An error of the library with the place put before it, unless it tells a line already.
template <class Action>
auto with_place(const std::string& place, Action action) {
  try {
    return action();
  } catch (const InputError& error) {
    const std::string text = error.what();
    if (text.find(", line ") < text.find(": ")) throw;
    throw InputError(place + ": " + text);
  }
}

const YamlTree& text_of(const YamlTree& map, const std::string& key, const std::string& allowed) {
  const YamlTree* value = map.find(key);
  if (!value)
    throw InputError(fmt::format("{}: keyword '{}'", map.origin, key), "is missing", allowed);
  if (value->kind != YamlTree::Kind::text)
    throw InputError(fmt::format("{}: keyword '{}'", value->origin, key), "is not a word", allowed);
  return *value;
}

constexpr std::size_t maximum_bases = 8;
const std::string cone_index = "cone_index";

/// The cone index of a file. @throws InputError for a value that is none
Options read_cone_index(const YamlTree& value) {
  Schema schema("material file");
  schema.number(cone_index, "Pa", Range::positive(), "mean of a cone test's first 15 cm");
  YamlTree map;
  map.kind = YamlTree::Kind::map;
  map.origin = value.origin;
  map.keys.emplace_back(cone_index, value);
  return read_map(schema, map);
}

/// The file that `base` names, beside the file at the end of `files`: each the base of the one
/// before.
std::string base_of(const YamlTree& name, const std::vector<std::string>& files) {
  const auto path = std::filesystem::path(files.back()).parent_path() / name.text;
  std::error_code unknown;
  for (const std::string& file : files)
    if (std::filesystem::equivalent(file, path, unknown))
      throw InputError(
          name.origin + ": base",
          fmt::format("leads back to {}: {} -> {}", file, fmt::join(files, " -> "), path.string()),
          "a base that does not need this file", "remove 'base' from one of them");
  if (files.size() > maximum_bases)
    throw InputError(name.origin + ": base", fmt::format("is the base of {} files", files.size()),
                     fmt::format("{} one after the other", maximum_bases));
  return path.string();
}

/// Puts the keys of a section over those of the base's section of that name.
void put_over(YamlTree& base, const YamlTree& section) {
  const YamlTree *type = section.find("type"), *base_type = base.find("type");
  const bool other_type = type && (!base_type || type->text != base_type->text);
  if (section.kind != YamlTree::Kind::map || base.kind != YamlTree::Kind::map || other_type) {
    base = section;
    return;
  }
  base.origin = section.origin;
  for (const auto& [key, value] : section.keys) {
    if (YamlTree* old = base.find(key))
      *old = value;
    else
      base.keys.emplace_back(key, value);
  }
}

/// The file with its base below it: every key knows the file it came from.
YamlTree read_with_base(const std::vector<std::string>& files) {
  YamlTree file = read_yaml(files.back());
  check_kind(file, InputKind::material);
  insert_contact_file(file, files.back());
  if (!file.find("base")) return file;
  const YamlTree name = text_of(file, "base", "a file beside this one");
  std::vector<std::string> more = files;
  more.push_back(base_of(name, files));
  YamlTree merged = with_place(name.origin + ": base", [&] { return read_with_base(more); });
  merged.origin = file.origin;
  merged.keys.erase(std::remove_if(merged.keys.begin(), merged.keys.end(),
                                   [](const auto& entry) { return entry.first == cone_index; }),
                    merged.keys.end());
  for (const auto& [key, value] : file.keys) {
    if (key == "base") continue;
    if (YamlTree* old = merged.find(key))
      put_over(*old, value);
    else
      merged.keys.emplace_back(key, value);
  }
  return merged;
}

}  // namespace

MaterialFile read_material_file(const std::string& path, const MaterialModels& models) {
  const YamlTree file = read_with_base({path});
  MaterialFile result;
  result.path = path;
  result.title = std::filesystem::path(path).stem().string();

  std::vector<std::string> law_names;
  for (const MaterialModel& model : models) law_names.push_back(model.name);
  const std::string one_of = fmt::format("one of: {}", fmt::join(law_names, ", "));
  const YamlTree& law_map =
      file.map("law", "the section 'law' with the law's name as 'type', and its keys");
  const YamlTree type = text_of(law_map, "type", one_of);
  if (std::find(law_names.begin(), law_names.end(), type.text) == law_names.end()) {
    const std::string near = did_you_mean(law_names, type.text);
    throw InputError(type.origin, fmt::format("has the unknown law '{}'", type.text), one_of,
                     near.empty() ? "furrow-point laws lists all with their keys" : near);
  }
  result.model = find_material_model(type.text, models);
  const MaterialModel& model = result.model;

  std::vector<std::string> of_cone_index;  // warnings, which explain nothing of the law
  for (const auto& [key, value] : file.keys) {
    if (key == "title") {
      result.title = text_of(file, key, "a text").text;
      continue;
    }
    if (key == "contact") continue;
    if (key == cone_index) {
      const Options options = read_cone_index(value);
      result.cone_index = options.number(cone_index);
      of_cone_index = options.warnings();
      continue;
    }
    const std::vector<std::string> names = section_names(model);
    if (std::find(names.begin(), names.end(), key) == names.end())
      throw InputError(
          value.origin,
          fmt::format("has the section '{}', which law {} does not have", key, model.name),
          fmt::format("title, base, contact, cone_index, {}", fmt::join(names, ", ")),
          did_you_mean(names, key));
    if (value.kind != YamlTree::Kind::map)
      throw InputError(fmt::format("{}: '{}'", value.origin, key), "is not a section of keys",
                       "keys with values, indented below it");
  }
  // Section by section first, so that a missing key is reported with the line of its section; then
  // the law as a whole.
  for (const SectionSchema& section : model.sections) {
    const YamlTree* map = file.find(section.name);
    YamlTree nothing;
    nothing.origin = path;
    if (!map) map = &nothing;
    const YamlTree* chosen = section.name == "law" ? nullptr : map->find("type");
    const std::string name =
        chosen ? text_of(*map, "type", "a word").text : section.choices.front().type;
    const SectionChoice choice =
        with_place(chosen ? chosen->origin : map->origin, [&] { return section.choice(name); });
    const Options options =
        with_place(map->origin, [&] { return read_map(choice.schema, *map, {"type"}); });
    result.warnings.insert(result.warnings.end(), options.warnings().begin(),
                           options.warnings().end());
    std::vector<std::string> aside;
    if (section.name == "law") aside.push_back("type");
    if (map != &nothing) result.sections[section.name] = entries_of(*map, aside);
    result.options.emplace(section.name, SectionOptions{name, options});
  }
  result.contact = contact_of(file);
  const std::unique_ptr<Material> material = with_place(path, [&] { return result.make(); });
  with_place(path, [&] {
    check_plausible(*material);
    return 0;
  });
  const bool has_warnings = !result.warnings.empty();
  result.warnings.insert(result.warnings.end(), of_cone_index.begin(), of_cone_index.end());
  if (has_warnings) return result;  // these warnings cause further ones
  for (const std::string& warning : plausibility_warnings(*material))
    result.warnings.push_back(fmt::format("{}: {}", path, warning));
  for (const std::string& warning : plausibility_warnings(result.options))
    result.warnings.push_back(fmt::format("{}: {}", path, warning));
  if (model.warnings)
    for (const std::string& warning : model.warnings(result.options))
      result.warnings.push_back(fmt::format("{}: {}", path, warning));
  return result;
}

std::unique_ptr<Material> load_material(const std::string& path, const MaterialModels& models) {
  return read_material_file(path, models).make();
}

std::string material_file_text(const std::string& title, const MaterialModel& model,
                               const MaterialOptions& options) {
  std::string text = fmt::format("title: {}\n", quoted(title));
  for (const SectionSchema& section : model.sections) {
    const SectionOptions& values = options.at(section.name);
    const Schema& schema = section.choice(values.type).schema;
    const std::string type = section.name == "law" ? model.name : values.type;
    text += fmt::format("{}:\n", section.name);
    if (!type.empty()) text += fmt::format("  type: {}\n", type);
    for (const Entry& entry : values.options.effective()) {
      const Key& key = *schema.find(entry.key);
      const bool list = key.kind == Key::Kind::numbers;
      const std::string value = fmt::format(list ? "[{}]" : "{}", fmt::join(entry.values, ", "));
      const std::string unit = key.unit.empty() ? "" : fmt::format("[{}] ", key.unit);
      text += fmt::format("  {}: {}  # {}{}\n", entry.key,
                          key.kind == Key::Kind::text ? quoted(value) : value, unit, key.meaning);
    }
  }
  return text;
}

}  // namespace furrow
