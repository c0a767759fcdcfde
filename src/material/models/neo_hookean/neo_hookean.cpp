// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/models/neo_hookean/neo_hookean.h"

#include <algorithm>
#include <cmath>

namespace furrow {

MaterialModel NeoHookean::model() {
  Schema schema("law neo_hookean");
  schema.number("density", "kg/m3", Range::positive(), "mass density at the start");
  schema.number("G", "Pa", Range::positive(), "shear modulus mu at small strain");
  schema.number("bulk", "Pa", Range::positive(), "bulk modulus K at small strain");
  MaterialModel model;
  model.name = "neo_hookean";
  model.meaning = "rubber: compressible neo-Hookean";
  model.sections = {law_section(schema)};
  model.create = [](const MaterialOptions& sections) -> std::unique_ptr<Material> {
    const Options& o = sections.at("law").options;
    return std::make_unique<NeoHookean>(o.number("density"),
                                        NeoHookeanParameters{o.number("G"), o.number("bulk")});
  };
  model.examples = {"density 1100 G 1e6 bulk 5e7"};
  return model;
}

NeoHookean::NeoHookean(double density, const NeoHookeanParameters& parameters)
    : KernelLaw("neo_hookean", density, parameters,
                {{"b_minus_i", "", "left Cauchy-Green tensor minus identity", 0.0,
                  StateVariable::Kind::symmetric_tensor}}) {}

ElasticModuli NeoHookean::moduli(const VectorX& state) const {
  // Along the axis of the largest principal stretch, with lambda^2 <= 1 + |b - I|: acoustic tensor
  // of W, each term bounded above.
  const double J = state[field::volume_ratio];
  const double stretch = 1.0 + state.segment<6>(b_minus_identity).cwiseAbs().sum();
  const double bulk = 0.5 * parameters_.bulk * (J + 1.0 / J);
  const double shear = parameters_.shear * std::pow(J, -5.0 / 3.0) * std::max(stretch, 1.0);
  return {bulk, shear};
}

}  // namespace furrow
