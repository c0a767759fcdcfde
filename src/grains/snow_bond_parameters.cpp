// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/grains/snow_bond_parameters.h"

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

// exp(60) is 1e26: with X < 1 no strength leaves the range of numbers
constexpr double largest_exponent = 60.0;
// Strength over modulus: light snow 15 Pa and 0.1 MPa, ice 5 MPa and 9 GPa. Beds are packed with 1.
constexpr double minimum_crush_strain = 1e-6;

}  // namespace

Schema SnowBondParameters::schema() {
  Schema schema("model snow/bond");
  schema.number("snowModulus", "Pa", Range::positive(),
                "E: contact stiffness over the diameter, normal and tangential");
  schema.number("snowCrushStrength", "Pa", Range::positive(),
                "Y0: crush force of a fresh bond over the diameter squared");
  schema.number("snowCrushHardening", "", Range::closed(0.0, largest_exponent),
                "p: exponent of the growth of Y0 with crushing");
  schema.number("snowDenseStrength", "Pa", Range::non_negative(),
                "Y1: crush force of dense snow over the diameter squared");
  schema.number("snowDenseHardening", "", Range::closed(0.0, largest_exponent),
                "q: exponent of the growth of Y1 with crushing");
  schema.number("snowBondHardening", "", Range::closed(0.0, largest_exponent),
                "pc: exponent of the growth of the bond strength with crushing");
  schema.number("snowShearStrength", "", Range::closed(0.0, 10.0),
                "chi: shear strength of a bond over its crush strength");
  schema.number("snowTensileStrength", "", Range::closed(0.0, 10.0),
                "zeta: tensile strength of a bond over its crush strength");
  schema.number("snowSintering", "", Range::closed(0.0, 10.0),
                "w: share of the crushed area that bonds; 0: contacts do not sinter");
  schema.number("snowDamping", "", Range::closed(0.0, 1.0),
                "damping ratio of the elastic normal motion; 1: critical");
  schema.number("coefficientFriction", "", Range::closed(0.0, 10.0), "mu: friction coefficient");
  return schema;
}

SnowBondParameters SnowBondParameters::from(const Options& options) {
  SnowBondParameters all;
  all.E = options.number("snowModulus");
  all.Y0 = options.number("snowCrushStrength");
  all.p = options.number("snowCrushHardening");
  all.Y1 = options.number("snowDenseStrength");
  all.q = options.number("snowDenseHardening");
  all.pc = options.number("snowBondHardening");
  all.chi = options.number("snowShearStrength");
  all.zeta = options.number("snowTensileStrength");
  all.w = options.number("snowSintering");
  all.damping = options.number("snowDamping");
  all.mu = options.number("coefficientFriction");
  if (all.Y0 < minimum_crush_strain * all.E || all.Y0 > all.E)
    throw InputError(options.where("snowCrushStrength"),
                     fmt::format("is {:g} Pa, with a snowModulus of {:g} Pa", all.Y0, all.E),
                     fmt::format("{:g} to 1 of the modulus", minimum_crush_strain),
                     "give both in Pa");
  return all;
}

}  // namespace furrow
