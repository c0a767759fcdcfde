// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/models/drucker_prager/drucker_prager.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

std::unique_ptr<Material> create_drucker_prager(const MaterialOptions& sections) {
  const Options& o = sections.at("law").options;
  DruckerPragerParameters parameters;
  parameters.elasticity = make_elasticity(sections.at("elasticity"));
  parameters.d = o.number("d");
  parameters.tan_beta = std::tan(radians(o.number("beta")));
  parameters.tan_psi = std::tan(radians(o.number("psi")));
  if (o.number("psi") > o.number("beta"))
    throw InputError(o.where("psi"), fmt::format("is {:g} degrees", o.number("psi")),
                     fmt::format("at most beta, {:g} degrees", o.number("beta")),
                     "0 keeps the volume");
  if (parameters.d == 0.0 && parameters.tan_beta == 0.0)
    throw InputError(o.where("d"), "and beta are both 0: the ground has no strength",
                     "one of them above 0");
  require_linear(parameters.elasticity, "drucker_prager",
                 "take drucker_prager_cap for porous elasticity");
  return std::make_unique<DruckerPrager>(o.number("density"), parameters);
}

}  // namespace

MaterialModel DruckerPrager::model() {
  Schema schema("law drucker_prager");
  schema.number("density", "kg/m3", Range::positive(), "mass density at the start");
  schema.number("d", "Pa", Range::closed(0.0, 1e9), "intercept of the shear line in the p-q plane");
  schema.number("beta", "degree", Range::closed(0.0, 80.0), "slope of the shear line");
  schema
      .number("psi", "degree", Range::closed(0.0, 80.0),
              "slope of the flow: dilation; beta: associated flow")
      .by_default(0.0);
  MaterialModel model;
  model.name = "drucker_prager";
  model.meaning = "cohesion, friction and dilation without hardening: clay, ideal sand";
  model.sections = {law_section(schema), elasticity_section()};
  model.create = create_drucker_prager;
  model.examples = {"density 1600 d 5e3 beta 10 psi 4 elasticity linear E 5e6 nu 0.2",
                    "density 1600 d 5e3 beta 10 psi 10 elasticity linear E 5e6 nu 0.3",
                    "density 1900 d 1e4 beta 0 elasticity linear E 5e6 nu 0.45"};
  return model;
}

DruckerPrager::DruckerPrager(double density, const DruckerPragerParameters& parameters)
    : ElasticKernelLaw("drucker_prager", density, parameters, plastic_strains()) {}

double DruckerPrager::yield_function(const VectorX& state) const {
  const Invariants stress = invariants(stress_of(state));
  return stress.q - parameters_.d - stress.p * parameters_.tan_beta;
}

std::vector<Vector2> DruckerPrager::yield_surface(const VectorX& state, std::size_t points) const {
  const double end = 10.0 * stress_scale(state),
               start = parameters_.tan_beta > 0.0 ? -parameters_.d / parameters_.tan_beta : -end;
  std::vector<Vector2> line;
  for (std::size_t i = 0; i < points; ++i) {
    const double p =
        start + (end - start) * static_cast<double>(i) / static_cast<double>(points - 1);
    line.emplace_back(p, parameters_.d + p * parameters_.tan_beta);
  }
  return line;
}

double DruckerPrager::stress_scale(const VectorX& state) const {
  const double stress = parameters_.d + std::abs(invariants(stress_of(state)).p);
  return std::max(stress, rounding_stress(state));
}

}  // namespace furrow
