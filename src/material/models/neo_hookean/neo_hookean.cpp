// SPDX-License-Identifier: GPL-2.0-or-later
#include "material/models/neo_hookean/neo_hookean.h"

#include <algorithm>
#include <cmath>

#include "material/kernels.h"

namespace furrow {

MaterialModel NeoHookean::law() {
  Schema schema("law neo_hookean");
  schema.number("density", "kg/m3", Range::positive(), "mass density at the start");
  schema.number("G", "Pa", Range::positive(), "shear modulus mu at small strain");
  schema.number("bulk", "Pa", Range::positive(), "bulk modulus K at small strain");
  return {"neo_hookean",
          "rubber: compressible neo-Hookean",
          {{"law", {{"", "", schema}}}},
          [](const MaterialOptions& sections) -> std::unique_ptr<Material> {
            const Options& o = sections.at("law").options;
            return std::make_unique<NeoHookean>(
                o.number("density"), NeoHookeanParameters{o.number("G"), o.number("bulk")});
          }};
}

NeoHookean::NeoHookean(double density, const NeoHookeanParameters& parameters)
    : Material("neo_hookean", density,
               [] {
                 std::vector<StateField> fields;
                 for (const char* component : {"xx", "yy", "zz", "xy", "yz", "xz"})
                   fields.push_back({std::string("b_minus_i_") + component, "",
                                     "left Cauchy-Green tensor minus identity", 0.0});
                 return fields;
               }()),
      parameters_(parameters) {}

UpdateReport NeoHookean::update_block(const PointBlock& block) const {
  return checked(kernels().neo_hookean(parameters_, density(), block), block);
}

ElasticModuli NeoHookean::moduli(const VectorX& state) const {
  // Along the axis of the largest principal stretch, with lambda^2 <= 1 + |b - I|: acoustic tensor
  // of W, each term bounded above.
  const double J = state[field::volume_ratio];
  const double stretch = 1.0 + state.segment<6>(b_minus_identity).cwiseAbs().sum();
  const double bulk = 0.5 * parameters_.bulk * (J + 1.0 / J);
  const double shear = parameters_.shear * std::pow(J, -5.0 / 3.0) * std::max(stretch, 1.0);
  return {bulk, shear};
}

double NeoHookean::stress_scale(const VectorX& state) const { return moduli(state).wave(); }

}  // namespace furrow
