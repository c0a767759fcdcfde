// SPDX-License-Identifier: GPL-2.0-or-later
#include "grains/snow_bond_parameters.h"

namespace furrow {

namespace {

// exp(60) is 1e26: with X < 1 no strength leaves the range of numbers
constexpr double largest_exponent = 60.0;

}  // namespace

Schema SnowBondParameters::schema() {
  Schema schema("model snow/bond");
  schema.number("snowModulus", "Pa", Range::positive(), "E: stiffness over the diameter");
  schema.number("snowCrushStrength", "Pa", Range::positive(),
                "Y0: force that crushes a fresh bond, over the squared diameter");
  schema.number("snowCrushHardening", "", Range::closed(0.0, largest_exponent),
                "p: its growth with the crushing");
  schema.number("snowDenseStrength", "Pa", Range::non_negative(),
                "Y1: crush strength of dense snow, likewise");
  schema.number("snowDenseHardening", "", Range::closed(0.0, largest_exponent),
                "q: its growth with the crushing");
  schema.number("snowBondHardening", "", Range::closed(0.0, largest_exponent),
                "pc: growth of the strength of a bond with the crushing");
  schema.number("snowShearStrength", "", Range::closed(0.0, 10.0),
                "chi: shear strength of a bond over its crush strength");
  schema.number("snowTensileStrength", "", Range::closed(0.0, 10.0),
                "zeta: tensile strength of a bond over its crush strength");
  schema.number("snowSintering", "", Range::closed(0.0, 10.0),
                "w: share of the crushed area that becomes bond; 0: contacts do not sinter");
  schema.number("snowDamping", "", Range::closed(0.0, 1.0),
                "damping of elastic motion along the normal, of critical");
  schema.number("coefficientFriction", "", Range::closed(0.0, 10.0), "mu: of Coulomb's law");
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
  return all;
}

}  // namespace furrow
