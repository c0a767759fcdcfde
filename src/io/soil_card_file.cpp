// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/soil_card_file.h"

#include <fmt/format.h>

#include "core/check_number.h"
#include "core/error.h"
#include "core/gravity.h"
#include "core/types.h"
#include "io/contact_section.h"
#include "io/yaml_tree.h"

namespace furrow {

namespace {

constexpr char what_a_card_is[] = "of a soil card, which furrow-post card make writes";

/// A schema of one value; its ranges are those of any soil.
double value_of(const YamlTree& entry, const std::string& name, const Range& range) {
  Schema schema("soil card, " + name);
  schema.number("value", "", range, name);
  return read_map(schema, entry, {"error", "unit"}).number("value");
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
  for (const char* name : {"k_c", "k_phi"})
    values[name] = value_of(plate.map(name, what_a_card_is), name, Range::any());
  values["n"] = value_of(plate.map("n", what_a_card_is), "n", Range::positive());
  for (const char* name : {"c", "phi"})
    values[name] = value_of(shear.map(name, what_a_card_is), name, Range::non_negative());
  values["K"] = value_of(shear.map("K", what_a_card_is), "K", Range::positive());
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
