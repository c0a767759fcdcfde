// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/models/elastic/elastic.h"

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
    : ElasticKernelLaw("elastic", density, parameters, {}) {}

}  // namespace furrow
