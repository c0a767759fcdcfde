// SPDX-License-Identifier: GPL-2.0-or-later
#include "material/models/elastic/elastic.h"

#include "material/elasticity/elasticity.h"
#include "simd/dispatch.h"

namespace furrow {

MaterialModel Elastic::model() {
  Schema schema("law elastic");
  schema.number("density", "kg/m3", Range::positive(), "mass density at the start");
  MaterialModel model;
  model.name = "elastic";
  model.meaning = "elastic ground, linear or porous";
  model.sections = {law_section(schema), elasticity_section()};
  model.create = [](const MaterialOptions& o) -> std::unique_ptr<Material> {
    return std::make_unique<Elastic>(o.at("law").options.number("density"),
                                     ElasticParameters{make_elasticity(o.at("elasticity"))});
  };
  model.examples = {"density 1600 elasticity linear E 5e6 nu 0.2",
                    "density 1600 elasticity porous kappa 0.01 e0 0.7 p0 1e4 pt_el 1e3 G 2e6"};
  return model;
}

Elastic::Elastic(double density, const ElasticParameters& parameters)
    : Material("elastic", density, {}, initial_pressure(parameters.elasticity)),
      parameters_(parameters) {}

UpdateReport Elastic::update_block(const PointBlock& block) const {
  return checked(kernels<ElasticKernels>().update(parameters_, density(), block), block);
}

ElasticModuli Elastic::moduli(const VectorX& state) const {
  return moduli_at(parameters_.elasticity, invariants(stress_of(state)).p);
}

double Elastic::largest_wave_speed(const PointBlock& block) const {
  return largest_elastic_wave_speed(parameters_.elasticity, density(), block);
}

}  // namespace furrow
