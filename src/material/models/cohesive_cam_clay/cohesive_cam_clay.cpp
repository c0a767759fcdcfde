// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/models/cohesive_cam_clay/cohesive_cam_clay.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/material/hardening/hardening.h"

namespace furrow {

namespace {

// Largest plausible M. Shear failure has q/p below 3; ellipses that fit the lateral stress of snow
// have 3 to 4.
constexpr double largest_M = 20.0;

std::unique_ptr<Material> create_cohesive_cam_clay(const MaterialOptions& sections) {
  const Options& o = sections.at("law").options;
  CohesiveCamClayParameters parameters;
  if (o.number("M") > largest_M)
    throw InputError(o.where("M"), fmt::format("is {:g}", o.number("M")),
                     fmt::format("a number in (0, {:g}]: a ratio q/p, no angle", largest_M),
                     "of a friction angle phi, M = 6 sin(phi)/(3 - sin(phi))");
  parameters.elasticity = make_elasticity(sections.at("elasticity"));
  parameters.hardening = make_hardening(sections.at("hardening"), o.number("density"));
  const double beta = o.number("tension_ratio"), eps_vol_pl_0 = o.number("eps_vol_pl_0");
  parameters.beta = beta;
  parameters.centre = 0.5 * (1.0 - beta);
  parameters.radius = 0.5 * (1.0 + beta);
  parameters.aspect = o.number("M") / std::sqrt(1.0 + 2.0 * beta);
  check_initial(parameters.hardening, o, "eps_vol_pl_0");
  check_reaches_tension(parameters.elasticity,
                        beta * strength_at(parameters.hardening, eps_vol_pl_0));
  return std::make_unique<CohesiveCamClay>(o.number("density"), parameters, eps_vol_pl_0);
}

}  // namespace

MaterialModel CohesiveCamClay::model() {
  Schema schema("law cohesive_cam_clay");
  schema.number("density", "kg/m3", Range::positive(), "mass density at the start");
  schema.number("M", "", Range::positive(),
                "slope of the ellipse: its height q over its half-width p, without cohesion");
  schema.number("tension_ratio", "", Range::closed(0.0, 1.0),
                "cohesion: hydrostatic tensile strength over compressive strength p0");
  schema
      .number("eps_vol_pl_0", "", Range::any(),
              "initial volumetric plastic strain, compression positive: size of the ellipse")
      .by_default(0.0);
  MaterialModel model;
  model.name = "cohesive_cam_clay";
  model.meaning = "crushing snow: ellipse and cohesion growing by compaction (Gaume et al., 2018)";
  model.sections = {law_section(schema), elasticity_section(), hardening_section()};
  model.create = create_cohesive_cam_clay;
  const std::string table =
      " hardening table p 500 2e4 4e5 2.4e7 eps_vol_pl 0 0.593 1.083 1.514 beyond extrapolate";
  model.examples = {
      "density 200 M 3.3 tension_ratio 0.1 eps_vol_pl_0 0.3 elasticity linear E 13.79e6 nu 0.3" +
          table + " interpolation log",
      "density 200 M 1.2 tension_ratio 0 eps_vol_pl_0 0.3 elasticity porous elasticity.kappa 0.005 "
      "elasticity.e0 3.5 elasticity.p0 10 pt_el 1e3 nu 0.3 "
      "hardening exponential pc0 113.76 lambda 0.35 hardening.kappa 0.005 hardening.e0 3.5"};
  return model;
}

CohesiveCamClay::CohesiveCamClay(double density, const CohesiveCamClayParameters& parameters,
                                 double eps_vol_pl_0)
    : ElasticKernelLaw("cohesive_cam_clay", density, parameters, plastic_strains(eps_vol_pl_0)) {}

double CohesiveCamClay::p0(double eps) const { return strength_at(parameters_.hardening, eps); }

double CohesiveCamClay::yield_function(const VectorX& state) const {
  const Invariants stress = invariants(stress_of(state));
  const double strength = p0(state[eps_vol_pl]);
  return std::hypot(stress.p - parameters_.centre * strength, stress.q / parameters_.aspect) -
         parameters_.radius * strength;
}

double CohesiveCamClay::stress_scale(const VectorX& state) const {
  const double stress = std::max(p0(state[eps_vol_pl]), std::abs(invariants(stress_of(state)).p));
  return std::max(stress, rounding_stress(state));
}

std::vector<Vector2> CohesiveCamClay::yield_surface(const VectorX& state,
                                                    std::size_t points) const {
  const double strength = p0(state[eps_vol_pl]), centre = parameters_.centre * strength,
               radius = parameters_.radius * strength;
  const std::size_t pieces = std::max<std::size_t>(points, 3) - 1;
  std::vector<Vector2> line;
  for (std::size_t i = 0; i <= pieces; ++i) {
    const double angle = pi * (1.0 - static_cast<double>(i) / static_cast<double>(pieces));
    line.emplace_back(centre + radius * std::cos(angle),
                      parameters_.aspect * radius * std::sin(angle));
  }
  return line;
}

}  // namespace furrow
