// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/inputs/contact_section.h"

#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

const Range frictions = Range::closed(0.0, 2.0);
const Range shear_limits{0.0, 1e6, true, false};     // [Pa]
const Range slip_lengths = Range::closed(0.0, 0.3);  // [m]; snow has 0.05 [Wong2008]

Schema body_schema(const std::string& material) {
  Schema schema("contact with " + material);
  schema.number("friction", "", frictions, "friction coefficient, the tangent of the angle");
  schema.numbers("friction_range", 2, "", frictions, "within which it lies");
  schema.number("slip_length", "m", slip_lengths, "slip distance that mobilises the friction");
  schema.numbers("slip_length_range", 2, "m", slip_lengths, "within which it lies");
  schema.number("shear_limit", "Pa", shear_limits, "largest shear stress, of clay its adhesion")
      .optional();
  schema.numbers("shear_limit_range", 2, "Pa", shear_limits, "within which it lies").optional();
  schema.choice("label", {"measured", "estimated", "assumed"}, "how both are known");
  schema.text("source", "where both come from");
  return schema;
}

/// @throws InputError for a value outside of its range
std::array<double, 2> range_of(const Options& options, const std::string& key) {
  const std::vector<double>& ends = options.numbers(key + "_range");
  const double value = options.number(key);
  if (!(ends[0] <= value && value <= ends[1]))
    throw InputError(options.where(key + "_range"),
                     fmt::format("is [{:g}, {:g}], and {} is {:g}", ends[0], ends[1], key, value),
                     "a lower and an upper end with the value between them");
  return {ends[0], ends[1]};
}

BodyContact read_body(const std::string& material, const YamlTree& map) {
  const Options options = read_map(body_schema(material), map);
  BodyContact contact;
  contact.friction = options.number("friction");
  contact.friction_range = range_of(options, "friction");
  contact.slip_length = options.number("slip_length");
  contact.slip_length_range = range_of(options, "slip_length");
  contact.label = options.text("label");
  contact.source = options.text("source");
  if (options.given("shear_limit") != options.given("shear_limit_range"))
    throw InputError(options.subject(), "has one of 'shear_limit' and 'shear_limit_range'",
                     "both or none", "give the range within which the limit lies");
  if (options.given("shear_limit")) {
    contact.shear_limit = options.number("shear_limit");
    contact.shear_limit_range = range_of(options, "shear_limit");
  }
  return contact;
}

GroundContact read_parts(const YamlTree& section) {
  GroundContact contact;
  refuse_other_keys(section, body_materials());
  for (const auto& [material, map] : section.keys) {
    if (map.kind != YamlTree::Kind::map)
      throw InputError(fmt::format("{}: '{}'", map.origin, material), "is not a section of keys",
                       "friction, slip_length, their ranges, label and source");
    contact.emplace(material, read_body(material, map));
  }
  return contact;
}

}  // namespace

void insert_contact_file(YamlTree& file, const std::string& path) {
  YamlTree* const section = file.find("contact");
  if (!section || section->kind != YamlTree::Kind::text) return;
  const auto other = std::filesystem::path(path).parent_path() / section->text;
  std::error_code absent;
  if (!std::filesystem::exists(other, absent))
    throw InputError(
        section->origin + ": keyword 'contact'",
        fmt::format("names the file {}, which is not there", other.string()),
        "a file next to this one, or a section with a part for each material of a body",
        "copy the contact file along with this one, or remove the line: a contact then needs "
        "'friction' and 'slip_length' on its line");
  *section = read_yaml(other.string());
}

GroundContact contact_of(const YamlTree& file) {
  if (!file.find("contact")) return {};
  return read_parts(
      file.map("contact", "a section with a part for each material of a body, or a file with it"));
}

GroundContact read_contact_file(const std::string& path) { return read_parts(read_yaml(path)); }

}  // namespace furrow
