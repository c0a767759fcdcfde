// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/inputs/soil_card_file.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "furrow/core/options/check_number.h"
#include "furrow/core/error.h"
#include "furrow/core/gravity.h"
#include "furrow/core/types.h"
#include "furrow/io/inputs/contact_section.h"
#include "furrow/io/formats/input_text.h"
#include "furrow/io/formats/units.h"
#include "furrow/io/formats/yaml_tree.h"

namespace furrow {

namespace {

constexpr std::uintmax_t largest_card = 4u << 20;  // [bytes]
constexpr char what_a_card_is[] = "of a soil card, which furrow-post card make writes";

/// Reads a parameter: a number, or a map of value, error and unit. @return in the SI unit
double value_of(const YamlTree& part, const std::string& name, const std::string& si,
                const Range& range) {
  const std::string subject = "soil card, " + name;
  Schema schema(subject);
  schema.number("value", "", range, name);
  schema.number("error", "", Range::any(), "standard error").optional();
  schema.text("unit", "of the value").by_default(si);
  const YamlTree* entry = part.find(name);
  need(entry != nullptr, part.origin, fmt::format("has no '{}'", name), "a number", what_a_card_is);
  std::vector<Entry> entries = {{"value", {entry->text}, entry->origin}};
  if (entry->kind != YamlTree::Kind::text) entries = entries_of(*entry);
  const Options options = schema.read(entries);
  const std::string& given = options.text("unit");
  if (given == si) return options.number("value");
  const Unit* unit = find_unit(given);
  need(unit && unit->si == si, options.where("unit"), fmt::format("is '{}'", given), units_of(si));
  return unit->factor * options.number("value");
}

/// Keys of "Soil parameters" in a terrain file of Chrono.
constexpr std::pair<const char*, const char*> of_chrono[] = {{"Bekker Kc", "k_c"},
                                                             {"Bekker Kphi", "k_phi"},
                                                             {"Bekker n exponent", "n"},
                                                             {"Mohr cohesive limit", "c"},
                                                             {"Mohr friction limit", "phi"},
                                                             {"Janosi shear coefficient", "K"},
                                                             {"Elastic stiffness", "stiffness"},
                                                             {"Damping", "damping"}};

/// The terrain file of Chrono's SCM. It states no gravity.
SoilCard read_chrono(const std::string& path) {
  const nlohmann::json file = nlohmann::json::parse(
      read_input_text(path, "a JSON file", largest_card), nullptr, false, true);
  need(!file.is_discarded(), path, "is no JSON", "a terrain file of Chrono's SCM");
  need(file.is_object() && file.contains("Soil parameters") && file["Soil parameters"].is_object(),
       path, "has no \"Soil parameters\"",
       "a terrain file of Chrono's SCM, or a soil card in YAML");
  SoilCard found;
  for (const auto& [key, value] : file["Soil parameters"].items()) {
    const auto known = std::find_if(std::begin(of_chrono), std::end(of_chrono),
                                    [&name = key](const auto& pair) { return pair.first == name; });
    need(known != std::end(of_chrono) && value.is_number(), path,
         fmt::format("has \"{}\": {} in \"Soil parameters\"", key, value.dump()),
         "numbers by the keys of Chrono's SCM");
    found.values[known->second] = value.get<double>();
  }
  for (const auto& [key, name] : of_chrono)
    need(found.values.count(name) || std::string(name) == "damping" ||
             std::string(name) == "stiffness",
         path, fmt::format("has no \"{}\" in \"Soil parameters\"", key), "a number");
  return found;
}

/// A value without an error.
double plain_value(const YamlTree& entry, const std::string& name, const std::string& unit,
                   const Range& range) {
  Schema schema("soil card");
  schema.number(name, unit, range, name);
  const std::vector<Entry> entries = {{name, {entry.text}, entry.origin}};
  return schema.read(entries).number(name);
}

/// The upper end of a range of the tests, or what there is without it.
double largest_of(const YamlTree& part, const std::string& name, double without) {
  const YamlTree* const range = part.find(name);
  if (!range) return without;
  if (range->kind != YamlTree::Kind::list)
    throw InputError(fmt::format("{}: '{}'", range->origin, name), "is not a list of two numbers",
                     "the least and the largest value of the tests", "write [0.001, 0.06]");
  Entry entry{name, {}, range->origin};
  for (const YamlTree& end : range->items) entry.values.push_back(end.text);
  Schema schema("soil card");
  schema.numbers(name, 2, "", Range::non_negative(), "range of the tests");
  return schema.read(std::vector<Entry>{entry}).numbers(name)[1];
}

}  // namespace

SoilCard read_soil_card(const std::string& path) {
  if (std::filesystem::path(path).extension() == ".json") return read_chrono(path);
  YamlTree card = read_yaml(path);
  insert_contact_file(card, path);
  const YamlTree& plate = card.map("pressure_sinkage", what_a_card_is);
  const YamlTree& shear = card.map("shear", what_a_card_is);
  for (const YamlTree* part : {&plate, &shear})
    if (const YamlTree* failed = part->find("failed"))
      throw InputError(failed->origin,
                       fmt::format("has no values, because the test failed: {}", failed->text),
                       "a card with the values of plates and ring",
                       "take another card, or give k_phi, n, c, phi and K by hand");
  SoilCard found;
  std::map<std::string, double>& values = found.values;
  found.deepest = largest_of(plate, "sinkage", found.deepest);
  found.largest_pressure = largest_of(plate, "pressure", found.largest_pressure);
  refuse_other_keys(card, {"title", "ground", "density", "stiffness", "gravity", "pressure_sinkage",
                           "shear", "cone", "notes", "damping", "c1", "c2", "contact"});
  refuse_other_keys(plate, {"k_c", "k_phi", "n", "sinkage", "pressure", "radii", "residual"});
  refuse_other_keys(shear, {"c", "phi", "K", "speed_stress", "normal", "displacement", "residual"});
  values["k_c"] = value_of(plate, "k_c", "N/m^(n+1)", Range::any());
  values["k_phi"] = value_of(plate, "k_phi", "N/m^(n+2)", Range::any());
  values["n"] = value_of(plate, "n", "", Range::positive());
  values["c"] = value_of(shear, "c", "Pa", Range::non_negative());
  values["phi"] = value_of(shear, "phi", "degree", Range::non_negative());
  values["K"] = value_of(shear, "K", "m", Range::positive());
  if (card.find("damping"))
    values["damping"] = value_of(card, "damping", "Pa s/m", Range::non_negative());
  if (const YamlTree* stiffness = card.find("stiffness"))
    values["stiffness"] = plain_value(*stiffness, "stiffness", "Pa/m", Range::positive());
  found.contact = contact_of(card);
  const YamlTree* const gravity = static_cast<const YamlTree&>(card).find("gravity");
  need(gravity != nullptr, path, "has no 'gravity'", "the gravity of the tests, in m/s^2",
       fmt::format("add the line 'gravity: {:g}' to a card of tests on the Earth",
                   standard_gravity));
  found.gravity = plain_value(*gravity, "gravity", "m/s^2", admissible_gravity());
  return found;
}

}  // namespace furrow
