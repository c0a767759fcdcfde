// SPDX-License-Identifier: GPL-2.0-or-later
#include "material/models/elastic/elastic.h"

#include "material/kernels.h"

namespace furrow {

MaterialModel Elastic::law() {
  Schema schema("law elastic");
  schema.number("density", "kg/m3", Range::positive(), "mass density at the start");
  return {"elastic",
          "elastic ground, linear or porous",
          {{"law", {{"", "", schema}}}, elasticity_section()},
          [](const MaterialOptions& o) -> std::unique_ptr<Material> {
            return std::make_unique<Elastic>(o.at("law").options.number("density"),
                                             make_elasticity(o.at("elasticity")));
          }};
}

Elastic::Elastic(double density, const ElasticityParameters& elasticity)
    : Material("elastic", density, {}, initial_pressure(elasticity)), elasticity_(elasticity) {}

UpdateReport Elastic::update_block(const PointBlock& block) const {
  return checked(kernels().elastic(elasticity_, density(), block), block);
}

ElasticModuli Elastic::moduli(const VectorX& state) const {
  return moduli_at(elasticity_, invariants(stress_of(state)).p);
}

double Elastic::largest_wave_speed(const PointBlock& block) const {
  return largest_elastic_wave_speed(elasticity_, density(), block);
}

double Elastic::stress_scale(const VectorX& state) const { return moduli(state).wave(); }

}  // namespace furrow
