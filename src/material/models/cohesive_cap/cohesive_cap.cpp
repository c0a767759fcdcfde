// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/models/cohesive_cap/cohesive_cap.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/material/hardening/hardening.h"

namespace furrow {

namespace {

constexpr double largest_nu_p = 0.49, largest_growth = 20.0, largest_aspect = 20.0;

std::unique_ptr<Material> create_cohesive_cap(const MaterialOptions& sections) {
  const Options& o = sections.at("law").options;
  const double density = o.number("density"), nu_p = o.number("nu_p");
  CohesiveCapParameters parameters;
  parameters.elasticity = make_elasticity(sections.at("elasticity"));
  parameters.hardening = make_hardening(sections.at("hardening"), density);
  parameters.flow = 4.5 * (1.0 - 2.0 * nu_p) / (1.0 + nu_p);
  parameters.aspect = o.has("aspect") ? o.number("aspect") : std::sqrt(parameters.flow);
  parameters.tan_beta = std::tan(radians(o.number("beta")));
  parameters.tension = o.number("tension_ratio");
  parameters.growth = o.number("d_exponent");
  parameters.relaxation = o.number("relaxation_time");
  parameters.d = o.number("d") * std::pow(density / o.number("d_density"), parameters.growth);
  if (parameters.tension * parameters.tan_beta > 1.0)
    throw InputError(o.where("tension_ratio"), fmt::format("is {:g}", parameters.tension),
                     fmt::format("at most {:.4g}: the apex of the shear line is at "
                                 "p = -d/tan(beta)",
                                 1.0 / parameters.tan_beta));
  const double eps_vol_pl_0 = o.number("eps_vol_pl_0");
  check_initial(parameters.hardening, o, "eps_vol_pl_0");
  check_reaches_tension(parameters.elasticity, parameters.tension * parameters.d *
                                                   std::exp(parameters.growth * eps_vol_pl_0));
  return std::make_unique<CohesiveCap>(density, parameters, eps_vol_pl_0);
}

}  // namespace

MaterialModel CohesiveCap::model() {
  Schema schema("law cohesive_cap");
  schema.number("density", "kg/m3", Range::positive(), "mass density at the start");
  schema.number("nu_p", "", Range::closed(0.0, largest_nu_p),
                "plastic Poisson's ratio of compaction: K0 = nu_p/(1 - nu_p)");
  schema.number("d", "Pa", Range::closed(0.0, 1e9),
                "intercept of the shear line in the p-q plane, at the density d_density");
  schema.number("d_density", "kg/m3", Range::positive(), "density at which d is given");
  schema.number("d_exponent", "", Range::closed(0.0, largest_growth),
                "d grows with the density to this power");
  schema.number("beta", "degree", Range::closed(0.0, 80.0), "slope of the shear line");
  schema.number("tension_ratio", "", Range::non_negative(),
                "hydrostatic tensile strength over d, at most 1/tan(beta)");
  schema
      .number("aspect", "", Range{0.0, largest_aspect, true, false},
              "height q of the cap over its half-width p; without it flow is associated")
      .optional();
  schema
      .number("eps_vol_pl_0", "", Range::any(),
              "initial volumetric plastic strain, compression positive")
      .by_default(0.0);
  schema
      .number("relaxation_time", "s", Range::non_negative(),
              "relaxation time of the viscous overstress; 0: strength without rate")
      .by_default(0.0);
  MaterialModel model;
  model.name = "cohesive_cap";
  model.meaning = "compressible snow: K0, cohesion over density and compaction curve independent";
  model.sections = {law_section(schema), elasticity_section(), hardening_section()};
  model.create = create_cohesive_cap;
  const std::string table =
      " hardening table p 500 2e4 4e5 2.4e7 eps_vol_pl 0 0.593 1.083 1.514 beyond extrapolate";
  model.examples = {
      "density 200 nu_p 0.1 d 2e3 d_density 200 d_exponent 3 beta 30 tension_ratio 0.2 "
      "eps_vol_pl_0 0.3 elasticity linear E 13.79e6 nu 0.3" +
          table + " interpolation log",
      "density 200 nu_p 0.25 d 1e3 d_density 300 d_exponent 4 beta 25 tension_ratio 0.5 aspect 2.5 "
      "eps_vol_pl_0 0.3 elasticity porous elasticity.kappa 0.005 elasticity.e0 3.5 "
      "elasticity.p0 10 pt_el 1e3 nu 0.3 "
      "hardening exponential pc0 113.76 lambda 0.35 hardening.kappa 0.005 hardening.e0 3.5"};
  model.examples.push_back(model.examples.front() + " relaxation_time 1e-3");
  return model;
}

CohesiveCap::CohesiveCap(double density, const CohesiveCapParameters& parameters,
                         double eps_vol_pl_0)
    : ElasticKernelLaw("cohesive_cap", density, parameters, plastic_strains(eps_vol_pl_0)) {}

double CohesiveCap::pc(double eps) const { return strength_at(parameters_.hardening, eps); }

double CohesiveCap::d(double eps) const {
  return parameters_.d * std::exp(std::clamp(parameters_.growth * eps, -80.0, 80.0));
}

double CohesiveCap::strength(double p, double eps) const {
  const double cap = pc(eps), inside = std::clamp(p / cap, 0.0, 1.0);
  const double line = std::max(d(eps) + p * parameters_.tan_beta, 0.0);
  return std::min(line, parameters_.aspect * cap * std::sqrt(1.0 - inside * inside));
}

double CohesiveCap::yield_function(const VectorX& state) const {
  const Invariants stress = invariants(stress_of(state));
  const double eps = state[eps_vol_pl], cohesion = d(eps);
  const double cap = std::hypot(std::max(stress.p, 0.0), stress.q / parameters_.aspect) - pc(eps);
  const double line = stress.q - std::max(cohesion + stress.p * parameters_.tan_beta, 0.0);
  return std::max({cap, line, -stress.p - parameters_.tension * cohesion});
}

double CohesiveCap::stress_scale(const VectorX& state) const {
  const double eps = state[eps_vol_pl];
  const double stress = std::max({pc(eps), d(eps), std::abs(invariants(stress_of(state)).p)});
  return std::max(stress, rounding_stress(state));
}

std::vector<Vector2> CohesiveCap::yield_surface(const VectorX& state, std::size_t points) const {
  const double eps = state[eps_vol_pl], start = -parameters_.tension * d(eps), end = pc(eps);
  const std::size_t pieces = std::max<std::size_t>(points, 4) - 2;
  std::vector<Vector2> line{{start, 0.0}};
  for (std::size_t i = 0; i <= pieces; ++i) {  // closer together towards the tip of the cap
    const double share = static_cast<double>(i) / static_cast<double>(pieces);
    const double p = start + (end - start) * std::sin(0.5 * pi * share);
    line.emplace_back(p, strength(p, eps));
  }
  return line;
}

}  // namespace furrow
