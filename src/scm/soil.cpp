// SPDX-License-Identifier: GPL-2.0-or-later
#include "scm/soil.h"

#include <fmt/format.h>

#include "core/check_number.h"
#include "core/error.h"
#include "core/types.h"

namespace furrow {

namespace {

constexpr double largest_angle = 60.0;  // degrees
const Range exponents{0.0, 3.0, true, false};

}  // namespace

double Soil::modulus(double width) const {
  const double modulus = (k_c == 0.0 ? 0.0 : k_c / width) + k_phi;
  if (!(modulus > 0.0))
    throw StateError(
        fmt::format("k_c/b + k_phi is {:.3g} Pa/m^n under a contact of b = {:.3g} m: the soil does "
                    "not resist; check 'k_c' and 'k_phi', or give 'contact_width'",
                    modulus, width));
  return modulus;
}

void Soil::match(Checkpoint& state) const {
  state.match("k_c", k_c);
  state.match("k_phi", k_phi);
  state.match("n", n);
  state.match("c", cohesion);
  state.match("phi", friction_angle);
  state.match("K", shear_length);
  state.match("stiffness", stiffness);
  state.match("damping", damping);
  state.match("flow", flow);
}

void declare_soil(Schema& schema) {
  schema.number("k_c", "N/m^(n+1)", Range::any(), "Bekker's cohesive modulus").by_default(0.0);
  schema.number("k_phi", "N/m^(n+2)", Range::any(), "Bekker's frictional modulus").optional();
  schema.number("n", "", exponents, "Bekker's exponent of the sinkage").optional();
  schema.number("c", "Pa", Range::non_negative(), "cohesion").optional();
  schema
      .number("phi", "degrees", Range::closed(0.0, largest_angle),
              "angle of internal friction, and of repose of the soil at the sides")
      .optional();
  schema.number("K", "m", Range::positive(), "shear displacement of Janosi and Hanamoto")
      .optional();
  schema
      .number("stiffness", "Pa/m", Range::positive(),
              "pressure per elastic sinkage, of unloading and reloading")
      .by_default(1e8);
  schema.number("damping", "Pa s/m", Range::non_negative(), "pressure per velocity of the sinkage")
      .by_default(0.0);
  schema
      .number("flow", "", Range::closed(0.0, 1.0),
              "share of the displaced volume that moves to the sides of the rut")
      .by_default(0.0);
}

Soil soil_from(const Options& options, const std::map<std::string, double>& card) {
  const auto value = [&](const char* key) {
    const auto of_card = card.find(key);
    if (of_card != card.end() && !options.given(key)) return of_card->second;
    need(options.has(key), options.where(key), "is missing", "a number",
         "give it, or a soil card with 'card'");
    return options.number(key);
  };
  Soil soil;
  soil.k_c = value("k_c");
  soil.k_phi = value("k_phi");
  soil.n = value("n");
  soil.cohesion = value("c");
  soil.friction_angle = radians(value("phi"));
  soil.shear_length = value("K");
  soil.stiffness = value("stiffness");
  soil.damping = value("damping");
  soil.flow = value("flow");
  check(soil, options.subject());
  return soil;
}

void check(const Soil& soil, const std::string& where) {
  const auto in = [&](double value, const Range& range, const char* name, const char* unit) {
    check_number(value, range, fmt::format("{}, {}", where, name), unit);
  };
  in(soil.n, exponents, "n", "");
  in(soil.cohesion, Range::non_negative(), "cohesion", "Pa");
  in(soil.friction_angle, Range::closed(0.0, radians(largest_angle)), "friction angle", "rad");
  in(soil.shear_length, Range::positive(), "K", "m");
  in(soil.stiffness, Range::positive(), "stiffness", "Pa/m");
  in(soil.damping, Range::non_negative(), "damping", "Pa s/m");
  in(soil.flow, Range::closed(0.0, 1.0), "flow", "");
  need(soil.k_c > 0.0 || soil.k_phi > 0.0, where, "has neither 'k_c' nor 'k_phi' above 0",
       "a soil that resists", "give 'k_phi'");
}

}  // namespace furrow
