// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/results/law_json.h"

#include <cmath>
#include <cstdlib>

#include <nlohmann/json.hpp>

#include "furrow/core/options/usual_range.h"

namespace furrow {

namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json) {
  return json.dump(1, ' ', false, Json::error_handler_t::replace);
}

const char* name_of(Key::Kind kind) {
  switch (kind) {
    case Key::Kind::number:
      return "number";
    case Key::Kind::integer:
      return "integer";
    case Key::Kind::numbers:
      return "numbers";
    case Key::Kind::choice:
      return "choice";
    case Key::Kind::text:
      return "text";
    case Key::Kind::flag:
      return "flag";
  }
  return "";
}

Json json_of(const UsualRange& usual) {
  return {{"unit", usual.unit},
          {"lower", usual.range.lower},
          {"upper", usual.range.upper},
          {"zero", usual.zero},
          {"hint", usual.hint}};
}

Json keys_of(const Schema& schema) {
  Json keys = Json::object();
  for (const Key& key : schema.keys()) {
    Json json = {{"kind", name_of(key.kind)}, {"allowed", key.allowed()}, {"meaning", key.meaning}};
    if (!key.unit.empty()) json["unit"] = key.unit;
    if (std::isfinite(key.range.lower)) json["lower"] = key.range.lower;
    if (std::isfinite(key.range.upper)) json["upper"] = key.range.upper;
    if (key.range.lower_open) json["lower_open"] = true;
    if (key.range.upper_open) json["upper_open"] = true;
    if (key.kind == Key::Kind::numbers) json["count"] = key.count;
    if (!key.choices.empty()) json["choices"] = key.choices;
    json["required"] = key.required;
    if (!key.default_values.empty()) json["default"] = key.default_values;
    if (const UsualRange* usual = find_usual_range(key.name, key.unit))
      json["usual"] = json_of(*usual);
    keys[key.name] = json;
  }
  return keys;
}

/// A number where the schema has one, else the text; a list for several.
Json value_of(const Key& key, const std::vector<std::string>& texts) {
  const bool number = key.kind == Key::Kind::number || key.kind == Key::Kind::integer ||
                      key.kind == Key::Kind::numbers;
  Json list = Json::array();
  for (const std::string& text : texts)
    list.push_back(number ? Json(std::strtod(text.c_str(), nullptr)) : Json(text));
  return key.kind == Key::Kind::numbers ? list : list.empty() ? Json() : list[0];
}

}  // namespace

std::string schemas_json(const std::vector<Schema>& schemas) {
  Json json = Json::object();
  for (const Schema& schema : schemas) json[schema.subject()] = keys_of(schema);
  return text_of(json);
}

std::string usual_ranges_json() {
  Json json = Json::object();
  for (const UsualRange& usual : usual_ranges()) json[usual.key] = json_of(usual);
  return text_of(json);
}

std::string laws_json(const MaterialModels& models) {
  Json laws = Json::object();
  for (const MaterialModel& model : models) {
    Json sections = Json::object();
    for (const SectionSchema& section : model.sections)
      for (const SectionChoice& choice : section.choices)
        sections[section.name][section.name == "law" ? model.name : choice.type] =
            keys_of(choice.schema);
    laws[model.name] = {{"meaning", model.meaning}, {"sections", sections}};
  }
  return text_of(laws);
}

std::string material_json(const MaterialFile& file, double pressure) {
  Json sections = Json::object();
  for (const SectionSchema& section : file.model.sections) {
    const SectionOptions& values = file.options.at(section.name);
    const Schema& schema = section.choice(values.type).schema;
    Json json = Json::object();
    const std::string type = section.name == "law" ? file.model.name : values.type;
    if (!type.empty()) json["type"] = type;
    for (const Entry& entry : values.options.effective())
      json[entry.key] = value_of(*schema.find(entry.key), entry.values);
    sections[section.name] = json;
  }
  const auto material = file.make();
  VectorX state = material->initial_state();
  state.segment<3>(field::stress).setConstant(-pressure);
  const ElasticModuli moduli = material->moduli(state);
  const double bulk = moduli.bulk, shear = moduli.shear;
  return text_of({{"title", file.title},
                  {"law", file.model.name},
                  {"sections", sections},
                  {"cone_index", file.cone_index ? Json(*file.cone_index) : Json()},
                  {"elastic",
                   {{"pressure", pressure},
                    {"density", material->density()},
                    {"bulk", bulk},
                    {"shear", shear},
                    {"young", 9.0 * bulk * shear / (3.0 * bulk + shear)},
                    {"poisson", (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear))},
                    {"wave_speed", std::sqrt(moduli.wave() / material->density())}}},
                  {"warnings", file.warnings}});
}

}  // namespace furrow
