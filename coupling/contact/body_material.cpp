// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/body_material.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "coupling/liggghts/styles/script.h"
#include "furrow/tyre/tyre.h"

namespace furrow::coupling {

namespace {

// Snow has 0.05 m [Wong2008], rubber on three soils 0.006 to 0.009 m [KRC]
constexpr double minimum_slip_length = 2e-4, largest_slip_length = 0.15;

/// True for a contact law whose line takes a largest shear stress.
bool takes_shear_limit(const Options& options) {
  const std::vector<Key>& keys = options.keys();
  return std::any_of(keys.begin(), keys.end(),
                     [](const Key& key) { return key.name == "shear_limit"; });
}

/// Text of a value: "friction 0.3 (0.2 to 0.5)", or the value of the line.
std::string value_text(const Options& options, const char* key, const char* unit, double known,
                       const std::array<double, 2>& range) {
  if (options.given(key))
    return fmt::format("{} {:g}{} (this line)", key, options.number(key), unit);
  return fmt::format("{} {:g}{} ({:g} to {:g})", key, known, unit, range[0], range[1]);
}

}  // namespace

void declare_body_material(Schema& schema, const std::vector<std::string>& others) {
  std::vector<std::string> materials = body_materials();
  materials.insert(materials.end(), others.begin(), others.end());
  schema
      .choice("body_material", materials,
              "material of the body's surface; by default rubber for a tyre, steel for others")
      .optional();
}

std::string body_material(const Options& options, const FixBody& body) {
  if (options.given("body_material")) return options.text("body_material");
  return dynamic_cast<const Tyre*>(&body.body()) ? "rubber" : "steel";
}

void warn_of_slip_length(LAMMPS_NS::LAMMPS& lammps, const Options& options) {
  if (!options.given("slip_length")) return;
  const double length = options.number("slip_length");
  if (length > largest_slip_length || (length > 0.0 && length < minimum_slip_length))
    warn(lammps,
         fmt::format(
             "{} is {:g} m; surfaces need {:g} to {:g} m to mobilise their friction; give m, or "
             "0 for friction without a slip length",
             options.where("slip_length"), length, minimum_slip_length, largest_slip_length));
}

BodyContact contact_with(LAMMPS_NS::LAMMPS& lammps, const Options& options, const FixBody& body,
                         const std::string& material, const Terrain& terrain,
                         const BodyContact& without, const std::string& consequence) {
  const auto [ground, known] = terrain.known_contact();
  const auto found = known.find(material);
  const bool has_limit = found != known.end() && std::isfinite(found->second.shear_limit);
  const bool limited = has_limit && takes_shear_limit(options);
  if (has_limit && !limited)
    warn(lammps,
         fmt::format("{}: the shear_limit of {:g} Pa that '{}' has for {} has no effect on "
                     "'{}'; use contact/continuum for adhesion, or remove it from the file",
                     options.subject(), found->second.shear_limit, ground, material, body.id));
  if (options.given("friction") && options.given("slip_length") && !limited) return without;
  if (found == known.end()) {
    const std::string missing = options.given("friction")      ? "slip_length"
                                : options.given("slip_length") ? "friction"
                                                               : "friction and slip_length";
    warn(
        lammps,
        fmt::format("{}: '{}' has no contact with {}, so that {} of '{}' {} unknown: {}; give what "
                    "was measured in this line, or a section 'contact' in the file of the ground",
                    options.subject(), ground, material, missing, body.id,
                    missing.find(" and ") == std::string::npos ? "is" : "are", consequence));
    return without;
  }
  const BodyContact& values = found->second;
  announce(
      lammps,
      fmt::format(
          "Contact of '{}' ({}) with '{}': {}, {}{}; {}: {}", body.id, material, ground,
          value_text(options, "friction", "", values.friction, values.friction_range),
          value_text(options, "slip_length", " m", values.slip_length, values.slip_length_range),
          limited ? ", " + value_text(options, "shear_limit", " Pa", values.shear_limit,
                                      values.shear_limit_range)
                  : "",
          values.label, values.source));
  return values;
}

void put_effective(std::vector<std::pair<std::string, std::string>>& settings, double friction,
                   double slip_length) {
  for (auto& [key, value] : settings)
    if (key == "friction" || key == "slip_length")
      value = fmt::format("{}", key == "friction" ? friction : slip_length);
}

}  // namespace furrow::coupling
