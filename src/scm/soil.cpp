// SPDX-License-Identifier: GPL-2.0-or-later
#include "scm/soil.h"

#include <fmt/format.h>

#include "core/check_number.h"
#include "core/error.h"
#include "core/types.h"

namespace furrow {

namespace {

constexpr double largest_angle = 60.0;  // degrees

}  // namespace

double Soil::modulus(double width) const {
  const double modulus = (kc == 0.0 ? 0.0 : kc / width) + kphi;
  if (!(modulus > 0.0))
    throw StateError(
        fmt::format("kc/b + kphi is {:.3g} Pa/m^n under a contact of b = {:.3g} m: the soil does "
                    "not resist; check 'kc' and 'kphi', or give 'contact_width'",
                    modulus, width));
  return modulus;
}

void declare_soil(Schema& schema) {
  schema.number("kc", "N/m^(n+1)", Range::any(), "Bekker's cohesive modulus").by_default(0.0);
  schema.number("kphi", "N/m^(n+2)", Range::any(), "Bekker's frictional modulus");
  schema.number("n", "", Range{0.0, 3.0, true, false}, "Bekker's exponent of the sinkage");
  schema.number("cohesion", "Pa", Range::non_negative(), "shear strength without pressure");
  schema.number("friction_angle", "degrees", Range::closed(0.0, largest_angle),
                "angle of internal friction, and of repose of the soil at the sides");
  schema.number("K", "m", Range::positive(), "shear displacement of Janosi and Hanamoto");
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

Soil soil_from(const Options& options) {
  Soil soil;
  soil.kc = options.number("kc");
  soil.kphi = options.number("kphi");
  soil.n = options.number("n");
  soil.cohesion = options.number("cohesion");
  soil.friction_angle = radians(options.number("friction_angle"));
  soil.shear_length = options.number("K");
  soil.stiffness = options.number("stiffness");
  soil.damping = options.number("damping");
  soil.flow = options.number("flow");
  check(soil, options.subject());
  return soil;
}

void check(const Soil& soil, const std::string& where) {
  const auto in = [&](double value, const Range& range, const char* name, const char* unit) {
    check_number(value, range, fmt::format("{}, {}", where, name), unit);
  };
  in(soil.n, Range{0.0, 3.0, true, false}, "n", "");
  in(soil.cohesion, Range::non_negative(), "cohesion", "Pa");
  in(soil.friction_angle, Range::closed(0.0, radians(largest_angle)), "friction angle", "rad");
  in(soil.shear_length, Range::positive(), "K", "m");
  in(soil.stiffness, Range::positive(), "stiffness", "Pa/m");
  in(soil.damping, Range::non_negative(), "damping", "Pa s/m");
  in(soil.flow, Range::closed(0.0, 1.0), "flow", "");
  need(soil.kc > 0.0 || soil.kphi > 0.0, where, "has neither 'kc' nor 'kphi' above 0",
       "a soil that resists", "give 'kphi'");
}

}  // namespace furrow
