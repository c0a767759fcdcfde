// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/scm/soil.h"

#include <cmath>

#include <fmt/format.h>

#include "furrow/core/options/check_number.h"
#include "furrow/core/error.h"
#include "furrow/core/types.h"
#include "furrow/core/options/usual_range.h"

namespace furrow {

namespace {

constexpr double largest_angle = 60.0;  // degrees
const Range exponents{0.0, 3.0, true, false};
// Soils of [Wong2008] and snow have c to 7e4 Pa and K to 0.04 m, compacted sand c of 7e5 Pa
const Range cohesions = Range::closed(0.0, 1e6), shear_lengths{0.0, 0.3, true, false};
constexpr double no_cohesion = 1e-6;  // [Pa] a fit gives this for 0
// Bekker's pressure at this sinkage under a contact of this width [m]: snow has 2 kPa, heavy clay
// 1.1 MPa [Wong2008]; 10 times less and more
constexpr double usual_sinkage = 0.05, usual_width = 0.1;
const Range pressures = Range::closed(200.0, 1e7);
constexpr double minimum_share_of_k_c = 1e-3;  // dry sand has 6e-3 [Wong2008]
constexpr char si_of_modulus[] = "give N/m^(n+2), not kN/m^(n+2) or MN/m^(n+2)";

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

void SoilPatches::add(int axis, double begin, const Soil& soil) {
  axis_ = axis;
  begins_.push_back(begin);
  soils_.push_back(soil);
}

const Soil& SoilPatches::at(const Vector2& place) const {
  std::size_t patch = 0;
  while (patch < begins_.size() && place[axis_] >= begins_[patch]) ++patch;
  return soils_[patch];
}

void SoilPatches::match(Checkpoint& state) const {
  state.match("soils", soils_.size());
  for (const double begin : begins_) state.match("begin of a soil", begin);
  for (const Soil& soil : soils_) soil.match(state);
}

void declare_soil(Schema& schema) {
  schema.number("k_c", "N/m^(n+1)", Range::any(), "Bekker's cohesive modulus").by_default(0.0);
  schema.number("k_phi", "N/m^(n+2)", Range::any(), "Bekker's frictional modulus").optional();
  schema.number("n", "", exponents, "Bekker's exponent of the sinkage").optional();
  schema.number("c", "Pa", cohesions, "cohesion").optional();
  schema
      .number("phi", "degrees", Range::closed(0.0, largest_angle),
              "angle of internal friction, and of repose of the soil at the sides; 0, or 2 or more")
      .optional();
  schema.number("K", "m", shear_lengths, "shear displacement of Janosi and Hanamoto").optional();
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

namespace {

/// @throws InputError for values that only another unit explains
/// @param where names the source of a key
template <class Where>
void check_plausible(const Soil& soil, Where where) {
  const double angle = degrees(soil.friction_angle);
  if (angle > 0.0 && angle < usual_range("phi").range.lower)
    throw InputError(
        where("phi"), fmt::format("is {:g} degrees", angle),
        fmt::format("0, or {:g} to {:g} degrees", usual_range("phi").range.lower, largest_angle),
        "give degrees, not radians");
  if (soil.k_phi > 0.0 && soil.k_phi < usual_range("k_phi").range.lower)
    throw InputError(where("k_phi"), fmt::format("is {:g} N/m^(n+2)", soil.k_phi),
                     fmt::format("at least {:g} N/m^(n+2), or below 0 for a large k_c",
                                 usual_range("k_phi").range.lower),
                     si_of_modulus);
  const double modulus = soil.k_c / usual_width + soil.k_phi;
  if (modulus <= 0.0) return;  // refused during the run, where the width is known
  const double pressure = modulus * std::pow(usual_sinkage, soil.n);
  if (!pressures.contains(pressure))
    throw InputError(
        where("k_phi"),
        fmt::format("is {:g}, and k_c {:g} and n {:g}: a pressure of {:.3g} Pa at a "
                    "sinkage of {:g} m under a contact {:g} m wide",
                    soil.k_phi, soil.k_c, soil.n, pressure, usual_sinkage, usual_width),
        fmt::format("a pressure of {:g} to {:g} Pa, from snow to heavy clay", pressures.lower,
                    pressures.upper),
        si_of_modulus);
  const double minimum_stiffness = pressure / usual_sinkage;
  if (soil.stiffness < minimum_stiffness)
    throw InputError(
        where("stiffness"), fmt::format("is {:g} Pa/m", soil.stiffness),
        fmt::format("at least {:.3g} Pa/m for this soil, which has {:.3g} Pa at a sinkage of "
                    "{:g} m and would spring back by more than that",
                    minimum_stiffness, pressure, usual_sinkage),
        "give Pa/m, not kPa/m");
}

}  // namespace

namespace {

/// @param line_first  a key of the line takes the place of that of the card
Soil soil_of(const Options& options, const std::map<std::string, double>& card, bool line_first) {
  const auto value = [&](const char* key) {
    const auto of_card = card.find(key);
    if (of_card != card.end() && !(line_first && options.given(key))) return of_card->second;
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
  check_plausible(soil, [&](const char* key) {
    return (line_first && options.given(key)) || !card.count(key)
               ? options.where(key)
               : fmt::format("soil card, {}", key);
  });
  return soil;
}

}  // namespace

Soil soil_from(const Options& options, const std::map<std::string, double>& card) {
  return soil_of(options, card, true);
}

Soil soil_of_card(const Options& options, const std::map<std::string, double>& card) {
  return soil_of(options, card, false);
}

void check(const Soil& soil, const std::string& where) {
  const auto in = [&](double value, const Range& range, const char* name, const char* unit) {
    check_number(value, range, fmt::format("{}, {}", where, name), unit);
  };
  in(soil.n, exponents, "n", "");
  in(soil.cohesion, cohesions, "cohesion", "Pa");
  in(soil.friction_angle, Range::closed(0.0, radians(largest_angle)), "friction angle", "rad");
  in(soil.shear_length, shear_lengths, "K", "m");
  in(soil.stiffness, Range::positive(), "stiffness", "Pa/m");
  in(soil.damping, Range::non_negative(), "damping", "Pa s/m");
  in(soil.flow, Range::closed(0.0, 1.0), "flow", "");
  need(soil.k_c > 0.0 || soil.k_phi > 0.0, where, "has neither 'k_c' nor 'k_phi' above 0",
       "a soil that resists", "give 'k_phi'");
}

std::vector<std::string> plausibility_warnings(const Soil& soil) {
  std::vector<std::string> found;
  const double cohesion = soil.cohesion > no_cohesion ? soil.cohesion : 0.0;
  for (const auto& [key, value] : {std::pair("c", cohesion), std::pair("K", soil.shear_length)})
    if (const std::string warning = usual_range(key).warning(value); !warning.empty())
      found.push_back(fmt::format("the parameter {} {}", key, warning));
  if (const double share = std::abs(soil.k_c) / (usual_width * std::abs(soil.k_phi));
      soil.k_c != 0.0 && soil.k_phi != 0.0 && share < minimum_share_of_k_c)
    found.push_back(fmt::format(
        "k_c is {:g}, {:.1g} of k_phi times a width of {:g} m; soils have {:g} or more, or 0; {}",
        soil.k_c, share, usual_width, minimum_share_of_k_c, si_of_modulus));
  return found;
}

}  // namespace furrow
