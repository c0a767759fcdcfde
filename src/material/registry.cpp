// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/registry.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

template <class Items>
std::string names_of(const Items& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(item.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

const MaterialModel& find_material_model(const std::string& name, const MaterialModels& models) {
  for (const MaterialModel& model : models)
    if (model.name == name) return model;
  throw InputError("material", fmt::format("has the unknown law '{}'", name), names_of(models));
}

MaterialOptions read_sections(const MaterialModel& model, const MaterialSections& sections) {
  for (const auto& given : sections)
    if (std::none_of(model.sections.begin(), model.sections.end(),
                     [&](const auto& known) { return known.name == given.first; }))
      throw InputError(fmt::format("law {}", model.name),
                       fmt::format("has no section '{}'", given.first), names_of(model.sections));
  MaterialOptions result;
  for (const SectionSchema& section : model.sections) {
    std::string type = section.choices.front().type;
    std::vector<Entry> entries;
    const auto given = sections.find(section.name);
    if (given != sections.end()) {
      for (const Entry& entry : given->second) {
        if (entry.key != "type") {
          entries.push_back(entry);
        } else if (entry.values.size() == 1) {
          type = entry.values.front();
        } else {
          throw InputError(fmt::format("section '{}', keyword 'type'", section.name),
                           fmt::format("has {} value(s)", entry.values.size()), "one word");
        }
      }
    }
    result.emplace(section.name, SectionOptions{type, section.choice(type).schema.read(entries)});
  }
  return result;
}

MaterialSections to_sections(const MaterialModel& model, const std::vector<Entry>& flat) {
  MaterialSections sections;
  std::vector<Entry> keys;
  std::map<std::string, std::string> types;
  for (const SectionSchema& section : model.sections)
    types[section.name] = section.choices.front().type;
  for (const Entry& entry : flat) {
    if (types.count(entry.key) == 0) {
      keys.push_back(entry);
      continue;
    }
    if (entry.values.size() != 1)
      throw InputError(fmt::format("keyword '{}'", entry.key),
                       fmt::format("has {} value(s)", entry.values.size()), "one word");
    types[entry.key] = entry.values.front();
    sections[entry.key].push_back({"type", entry.values});
  }
  for (const Entry& entry : keys) {
    std::vector<std::string> owners, known;
    std::string bare = entry.key;
    const std::size_t dot = entry.key.find('.');
    if (dot != std::string::npos) bare = entry.key.substr(dot + 1);
    for (const SectionSchema& section : model.sections) {
      if (dot != std::string::npos && section.name != entry.key.substr(0, dot)) continue;
      const Schema& schema = section.choice(types[section.name]).schema;
      for (const Key& key : schema.keys()) known.push_back(key.name);
      if (schema.find(bare)) owners.push_back(section.name);
    }
    if (owners.empty())
      throw InputError(fmt::format("law {}", model.name),
                       fmt::format("has no keyword '{}'", entry.key),
                       fmt::format("{}", fmt::join(known, ", ")));
    if (owners.size() > 1)
      throw InputError(fmt::format("law {}, keyword '{}'", model.name, entry.key),
                       "belongs to more than one section",
                       fmt::format("{}.{}", fmt::join(owners, "." + bare + ", "), bare));
    sections[owners.front()].push_back({bare, entry.values});
  }
  return sections;
}

std::unique_ptr<Material> make_material(const MaterialModel& model,
                                        const MaterialSections& sections) {
  return model.create(read_sections(model, sections));
}

std::unique_ptr<Material> make_material(const std::string& name, const MaterialSections& sections,
                                        const MaterialModels& models) {
  return make_material(find_material_model(name, models), sections);
}

std::unique_ptr<Material> make_material(const MaterialModel& model,
                                        const std::vector<Entry>& flat) {
  return make_material(model, to_sections(model, flat));
}

std::unique_ptr<Material> make_material(const std::string& name, const std::vector<Entry>& flat,
                                        const MaterialModels& models) {
  return make_material(find_material_model(name, models), flat);
}

}  // namespace furrow
