// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/inputs/brick_tyre_file.h"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "furrow/core/error.h"
#include "furrow/io/inputs/input_kind.h"
#include "furrow/io/formats/yaml_tree.h"

namespace furrow {

namespace {

// Wider than any tyre needs, and narrow enough to find a wrong unit
const Range brick_tyre_length = Range::closed(0.0, 10.0);  // [m]
const Range stiffness = Range::closed(1.0, 1e10);          // [N/m]
const Range bending = Range::closed(1e-6, 1e5);            // [N m]
// [Pa] from the softest gel to rubber as stiff as plastic: kPa and MPa lie below
const Range rubber_modulus = Range::closed(2e4, 1e9);
constexpr double usual_bulk_ratio = 50.0;  // K/mu of a Poisson's ratio of 0.49

Schema brick_tyre_schema() {
  Schema schema("tyre");
  schema.number("pressure", "Pa", Range::closed(0.0, largest_inflation),
                "inflation pressure above atmospheric pressure");
  return schema;
}

Schema carcass_schema() {
  Schema schema("carcass");
  schema.numbers("axial", 0, "m", brick_tyre_length,
                 "points of the mid-surface's outline, without pressure, from the mid-plane (0) to "
                 "the bead: distance from the mid-plane");
  schema.numbers("radius", 0, "m", brick_tyre_length, "the same points: distance from the axle");
  schema.numbers(
      "zone_end", 0, "m", brick_tyre_length,
      "where each zone ends, along the outline from the mid-plane; the last at the bead");
  schema.numbers("stretch_along", 0, "N/m", stiffness,
                 "stiffness of each zone against stretching along the circumference, per width");
  schema.numbers("stretch_across", 0, "N/m", stiffness,
                 "stiffness of each zone against stretching along the outline, per width");
  schema.numbers("shear", 0, "N/m", stiffness, "stiffness of each zone against shear, per width");
  schema.numbers("bending_along", 0, "N m", bending,
                 "EI per width against bending along the circumference");
  schema.numbers("bending_across", 0, "N m", bending, "EI per width against bending across");
  schema.numbers("areal_mass", 0, "kg/m2", Range::closed(0.01, 1e4), "mass per area");
  schema.flag("cords",
              "`yes`: shells turn with the cords, whose tension does no work when they slide past "
              "each other");
  return schema;
}

Schema cap_schema() {
  Schema schema("cap");
  schema.numbers("at", 0, "m", brick_tyre_length,
                 "places along the carcass's outline, from 0 to where the tread ends");
  schema.numbers(
      "thickness", 0, "m", brick_tyre_length,
      "thickness of the rubber there, above the mid-surface of the carcass; 0 at the end");
  schema.integer("layers", Range::closed(1, 10), "layers of bricks below the voids")
      .by_default("1");
  schema.integer("rib_layers", Range::closed(1, 10), "layers of bricks next to the voids")
      .by_default("1");
  schema.number("C10", "Pa", rubber_modulus,
                "C10 of the neo-Hookean rubber: half its shear modulus");
  schema
      .number("bulk", "Pa", Range::closed(1e4, 1e11), "bulk modulus; 50 shear moduli if not given")
      .optional();
  schema.number("density", "kg/m3", Range::closed(1.0, 1e4), "density of the rubber");
  return schema;
}

Schema voids_schema() {
  Schema schema("voids");
  schema.numbers("from", 0, "m", brick_tyre_length,
                 "place along the outline of the carcass where each void begins");
  schema.numbers("to", 0, "m", brick_tyre_length, "place along the outline where each void ends");
  schema.numbers("depth", 0, "m", brick_tyre_length, "depth below the outside of the tread");
  schema.numbers("pitches", 0, "", Range::closed(0, 1000),
                 "gaps between bars around the tyre; 0: a groove around the tyre");
  schema.optional();
  schema.numbers("share", 0, "", Range::closed(0.0, 1.0), "share of a pitch that is a gap");
  schema.optional();
  return schema;
}

/// Lists of a section of which each place is one thing are equally long.
std::size_t common_length(const Options& options, const std::vector<std::string>& keys) {
  const std::size_t count = options.numbers(keys.front()).size();
  for (const std::string& key : keys)
    if (options.has(key) && options.numbers(key).size() != count)
      throw InputError(options.where(key),
                       fmt::format("has {} values", options.numbers(key).size()),
                       fmt::format("{}, as '{}' has", count, keys.front()));
  return count;
}

CarcassParameters carcass_of(const Options& options) {
  CarcassParameters carcass;
  common_length(options, {"axial", "radius"});
  carcass.axial = options.numbers("axial");
  carcass.radius = options.numbers("radius");
  carcass.cords = options.flag("cords");
  const std::size_t zones =
      common_length(options, {"zone_end", "stretch_along", "stretch_across", "shear",
                              "bending_along", "bending_across", "areal_mass"});
  for (std::size_t i = 0; i < zones; ++i) {
    const auto value = [&](const char* key) { return options.numbers(key)[i]; };
    carcass.zones.push_back({value("zone_end"),
                             {value("stretch_along"), value("stretch_across"), value("shear"),
                              value("bending_along"), value("bending_across")},
                             value("areal_mass")});
  }
  return carcass;
}

TreadCapParameters cap_of(const Options& options) {
  TreadCapParameters cap;
  common_length(options, {"at", "thickness"});
  cap.at = options.numbers("at");
  cap.thickness = options.numbers("thickness");
  cap.layers = static_cast<int>(options.integer("layers"));
  cap.rib_layers = static_cast<int>(options.integer("rib_layers"));
  const double shear = 2.0 * options.number("C10");
  const double bulk = options.has("bulk") ? options.number("bulk") : usual_bulk_ratio * shear;
  if (!(bulk > shear))
    throw InputError(options.where("bulk"), fmt::format("is {:g} Pa", bulk),
                     fmt::format("more than the shear modulus 2 C10 = {:g} Pa", shear),
                     "50 times that is usual: a Poisson's ratio of 0.49");
  cap.rubber = {{shear, bulk}, options.number("density")};
  return cap;
}

std::vector<TreadVoid> voids_of(const Options& options) {
  std::vector<TreadVoid> voids;
  const std::size_t count = common_length(options, {"from", "to", "depth", "pitches", "share"});
  for (std::size_t i = 0; i < count; ++i) {
    TreadVoid cut{options.numbers("from")[i], options.numbers("to")[i],
                  options.numbers("depth")[i]};
    if (options.has("pitches")) {
      const double pitches = options.numbers("pitches")[i];
      if (pitches != std::floor(pitches))
        throw InputError(options.where("pitches"), fmt::format("is {}", pitches), "whole numbers");
      cut.pitches = static_cast<int>(pitches);
    }
    if (options.has("share")) cut.share = options.numbers("share")[i];
    voids.push_back(cut);
  }
  return voids;
}

template <class Items, class Value>
std::string list(const Items& items, Value value) {
  std::vector<double> values;
  for (const auto& item : items) values.push_back(value(item));
  return fmt::format("[{}]", fmt::join(values, ", "));
}

}  // namespace

TyreSchemas brick_tyre_schemas() {
  return {{"tyre", brick_tyre_schema()},
          {"carcass", carcass_schema()},
          {"cap", cap_schema()},
          {"voids", voids_schema()}};
}

bool is_brick_tyre_file(const std::string& path) {
  return is_kind(read_yaml(path), InputKind::brick_tyre);
}

BrickTyreParameters read_brick_tyre_file(const std::string& path) {
  const YamlTree file = read_yaml(path);
  check_kind(file, InputKind::brick_tyre);
  refuse_other_keys(file, {"title", "tyre", "carcass", "cap", "voids"});
  const auto read = [&](const Schema& schema, const std::string& meaning) {
    return read_map(schema, file.map(schema.subject(), meaning));
  };
  BrickTyreParameters result;
  result.title = tyre_title(file, path);
  result.pressure =
      read(brick_tyre_schema(), "the section 'tyre' with the pressure").number("pressure");
  result.carcass =
      carcass_of(read(carcass_schema(), "the section 'carcass' with its outline and zones"));
  result.tread = cap_of(read(cap_schema(), "the section 'cap' with the tread's rubber"));
  if (file.find("voids"))
    result.tread.voids = voids_of(read(voids_schema(), "the section 'voids'"));
  check(result, fmt::format("{}: tyre '{}'", path, result.title));
  return result;
}

std::string brick_tyre_file_text(const BrickTyreParameters& tyre) {
  const CarcassParameters& carcass = tyre.carcass;
  const TreadCapParameters& cap = tyre.tread;
  const auto same = [](double value) { return value; };
  using Zone = CarcassZone;
  using Void = TreadVoid;
  const auto of_zones = [&](auto value) { return list(carcass.zones, value); };
  const auto of_voids = [&](auto value) { return list(cap.voids, value); };
  TyreValues values = {
      {"tyre", {{"pressure", fmt::to_string(tyre.pressure)}}},
      {"carcass",
       {{"axial", list(carcass.axial, same)},
        {"radius", list(carcass.radius, same)},
        {"zone_end", of_zones([](const Zone& zone) { return zone.end; })},
        {"stretch_along", of_zones([](const Zone& zone) { return zone.wall.stretch1; })},
        {"stretch_across", of_zones([](const Zone& zone) { return zone.wall.stretch2; })},
        {"shear", of_zones([](const Zone& zone) { return zone.wall.shear; })},
        {"bending_along", of_zones([](const Zone& zone) { return zone.wall.bending1; })},
        {"bending_across", of_zones([](const Zone& zone) { return zone.wall.bending2; })},
        {"areal_mass", of_zones([](const Zone& zone) { return zone.areal_mass; })},
        {"cords", carcass.cords ? "yes" : "no"}}},
      {"cap",
       {{"at", list(cap.at, same)},
        {"thickness", list(cap.thickness, same)},
        {"layers", fmt::to_string(cap.layers)},
        {"rib_layers", fmt::to_string(cap.rib_layers)},
        {"C10", fmt::to_string(0.5 * cap.rubber.law.shear)},
        {"bulk", fmt::to_string(cap.rubber.law.bulk)},
        {"density", fmt::to_string(cap.rubber.density)}}},
      {"voids",
       {{"from", of_voids([](const Void& cut) { return cut.from; })},
        {"to", of_voids([](const Void& cut) { return cut.to; })},
        {"depth", of_voids([](const Void& cut) { return cut.depth; })},
        {"pitches", of_voids([](const Void& cut) { return double(cut.pitches); })},
        {"share", of_voids([](const Void& cut) { return cut.share; })}}}};
  if (cap.voids.empty()) values.erase("voids");
  return tyre_sections_text(tyre.title, brick_tyre_schemas(), values);
}

}  // namespace furrow
