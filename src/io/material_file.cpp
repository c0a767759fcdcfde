// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/material_file.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.h"

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

/// A text as YAML reads it back, whatever it contains.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

/// The file with its base below it: every key knows the file it came from.
YamlTree read_with_base(const std::string& path, int depth = 0) {
  YamlTree file = read_yaml(path);
  if (!file.find("base")) return file;
  const YamlTree& name = text_of(file, "base", "a file beside this one");
  if (depth == 8)
    throw InputError(name.origin, "is the eighth base of a base", "fewer",
                     "does a file have itself as base?");
  YamlTree merged =
      read_with_base((std::filesystem::path(path).parent_path() / name.text).string(), depth + 1);
  merged.origin = file.origin;
  for (const auto& [key, value] : file.keys) {
    if (key == "base") continue;
    const auto same_key = [&k = key](const auto& pair) { return pair.first == k; };
    const auto old = std::find_if(merged.keys.begin(), merged.keys.end(), same_key);
    if (old == merged.keys.end()) {
      merged.keys.emplace_back(key, value);
      continue;
    }
    const YamlTree *type = value.find("type"), *old_type = old->second.find("type");
    const bool other_type = type && (!old_type || type->text != old_type->text);
    if (value.kind != YamlTree::Kind::map || other_type) {
      old->second = value;
      continue;
    }
    old->second.origin = value.origin;
    for (const auto& change : value.keys) {
      auto& keys = old->second.keys;
      const auto place = std::find_if(keys.begin(), keys.end(),
                                      [&](const auto& pair) { return pair.first == change.first; });
      if (place == keys.end())
        keys.push_back(change);
      else
        place->second = change.second;
    }
  }
  return merged;
}

}  // namespace

MaterialFile read_material_file(const std::string& path, const MaterialModels& models) {
  const YamlTree file = read_with_base(path);
  MaterialFile result;
  result.path = path;
  result.title = std::filesystem::path(path).stem().string();

  std::vector<std::string> law_names;
  for (const MaterialModel& model : models) law_names.push_back(model.name);
  const std::string one_of = fmt::format("one of: {}", fmt::join(law_names, ", "));
  const YamlTree& law_map =
      file.map("law", "the section 'law' with the law's name as 'type', and its keys");
  const YamlTree& type = text_of(law_map, "type", one_of);
  if (std::find(law_names.begin(), law_names.end(), type.text) == law_names.end())
    throw InputError(type.origin, fmt::format("has the unknown law '{}'", type.text), one_of,
                     "furrow-point laws lists all with their keys");
  result.model = find_material_model(type.text, models);
  const MaterialModel& model = result.model;

  for (const auto& [key, value] : file.keys) {
    if (key == "title") {
      result.title = text_of(file, key, "a text").text;
      continue;
    }
    const std::vector<std::string> names = section_names(model);
    if (std::find(names.begin(), names.end(), key) == names.end())
      throw InputError(
          value.origin,
          fmt::format("has the section '{}', which law {} does not have", key, model.name),
          fmt::format("title, base, {}", fmt::join(names, ", ")));
    if (value.kind != YamlTree::Kind::map)
      throw InputError(fmt::format("{}: '{}'", value.origin, key), "is not a section of keys",
                       "keys with values, indented below it");
    std::vector<std::string> aside;
    if (key == "law") aside.push_back("type");
    result.sections[key] = entries_of(value, aside);
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
    with_place(map->origin, [&] { return read_map(choice.schema, *map, {"type"}); });
  }
  with_place(path, [&] { return result.make(); });
  return result;
}

std::unique_ptr<Material> load_material(const std::string& path, const MaterialModels& models) {
  return read_material_file(path, models).make();
}

std::string material_file_text(const std::string& title, const MaterialModel& model,
                               const MaterialSections& sections) {
  const MaterialOptions options = read_sections(model, sections);
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
