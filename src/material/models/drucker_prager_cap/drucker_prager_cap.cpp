// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/models/drucker_prager_cap/drucker_prager_cap.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/material/hardening/hardening.h"
#include "furrow/material/section/section.h"

namespace furrow {

namespace {

std::unique_ptr<Material> create_drucker_prager_cap(const MaterialOptions& sections) {
  const Options& o = sections.at("law").options;
  DruckerPragerCapParameters parameters;
  parameters.elasticity = make_elasticity(sections.at("elasticity"));
  parameters.hardening = make_hardening(sections.at("hardening"), o.number("density"));
  const double beta = radians(o.number("beta"));
  parameters.d = o.number("d");
  parameters.tan_beta = std::tan(beta);
  parameters.sin_beta = std::sin(beta);
  parameters.R = o.number("R");
  parameters.alpha = o.number("alpha");
  parameters.B = 1.0 - parameters.alpha / std::cos(beta);
  parameters.A = parameters.B + parameters.alpha;
  parameters.section = make_section(o);
  if (parameters.B <= 0.0)
    throw InputError(o.where("alpha"),
                     fmt::format("is {}: the transition would be wider than the shear strength",
                                 parameters.alpha),
                     fmt::format("below cos(beta) = {:.4g}", std::cos(beta)),
                     "0.01 to 0.05 is usual");
  const double apex = parameters.d / parameters.tan_beta;
  parameters.cutoff = o.has("tension") ? o.number("tension") : apex;
  if (parameters.cutoff > apex * (1.0 + 1e-12))
    throw InputError(o.where("tension"),
                     fmt::format("is {} Pa, beyond the apex of the shear line", parameters.cutoff),
                     fmt::format("at most d/tan(beta) = {:.6g} Pa", apex),
                     "leave it out to cut at the apex");
  const double lowest_pa = parameters.R * parameters.d / (1.0 + parameters.R * parameters.tan_beta);
  const double min_limit = std::max(parameters.cutoff, lowest_pa);  // p, pa stay above its negative
  if (parameters.elasticity.porous && parameters.elasticity.limit <= min_limit)
    throw InputError("elasticity porous, keyword 'pt_el'",
                     fmt::format("is {} Pa", parameters.elasticity.limit),
                     fmt::format("above the tensile strength, {:.6g} Pa", min_limit),
                     "raise it, or lower the tension cut-off");
  check_initial(parameters.hardening, o, "eps_vol_pl_0");
  return std::make_unique<DruckerPragerCap>(o.number("density"), parameters,
                                            o.number("eps_vol_pl_0"));
}

constexpr double usual_R = 5.0;
constexpr double usual_cohesion = 5e6;         // [Pa] of ice and weak rock
constexpr double usual_stiffness_ratio = 0.1;  // d/E; clay has up to 0.02 [Bowles1996]
// Fresh snow of 50 kg/m3 has a shear strength of 90 Pa [Jamieson2001]
constexpr double usual_cohesion_of_snow = 20.0, snow_density = 600.0;  // [Pa], [kg/m3]

/// Warnings about other units, and sections that belong to two grounds.
std::vector<std::string> cap_warnings(const MaterialOptions& sections) {
  const Options& law = sections.at("law").options;
  const double d = law.number("d"), R = law.number("R");
  std::vector<std::string> sentences;
  if (R > usual_R)
    sentences.push_back(
        fmt::format("R is {:g}; caps of soils and snow have 0.0001 to {:g}", R, usual_R));
  if (d > usual_cohesion)
    sentences.push_back(
        fmt::format("d is {:g} Pa; ice and weak rock have up to {:g} Pa", d, usual_cohesion));
  const SectionOptions& elasticity = sections.at("elasticity");
  if (elasticity.type == "linear" && d > usual_stiffness_ratio * elasticity.options.number("E"))
    sentences.push_back(fmt::format(
        "d is {:g} Pa and E {:g} Pa; ground has a d of at most {:g} E; give both in Pa, not d in "
        "mPa or E in kPa",
        d, elasticity.options.number("E"), usual_stiffness_ratio));
  if (d > 0.0 && d < usual_cohesion_of_snow && law.number("density") < snow_density)
    sentences.push_back(
        fmt::format("d is {:g} Pa at {:g} kg/m3; snow has at least {:g} Pa; give Pa, not kPa", d,
                    law.number("density"), usual_cohesion_of_snow));
  return sentences;
}

}  // namespace

MaterialModel DruckerPragerCap::model() {
  Schema schema("law drucker_prager_cap");
  schema.number("density", "kg/m3", Range::positive(), "mass density at the start");
  schema.number("d", "Pa", Range::closed(0.0, 1e9), "cohesion: t at p = 0 on the shear line");
  schema.number("beta", "degree", Range{0.0, 80.0, true, false},
                "slope of the shear line in the p-t plane");
  schema.number("R", "", Range::positive(),
                "eccentricity of the cap: its half-width in p over R is its height");
  schema
      .number("alpha", "", Range{0.0, 1.0, false, true},
              "size of the transition between shear line and cap")
      .by_default(0.0);
  declare_section(schema);
  schema
      .number("eps_vol_pl_0", "", Range::any(),
              "initial volumetric plastic strain, compression positive: positions the cap")
      .by_default(0.0);
  schema
      .number("tension", "Pa", Range::non_negative(),
              "tension cut-off: p stays above -tension; the apex d/tan(beta) unless given")
      .optional();
  MaterialModel model;
  model.name = "drucker_prager_cap";
  model.meaning =
      "soils and snow: shear line, transition, hardening cap (ABAQUS, [Shoop2001] eq 12-16)";
  model.sections = {law_section(schema), elasticity_section(), hardening_section()};
  model.create = create_drucker_prager_cap;
  model.warnings = cap_warnings;
  const std::string snow =
      " hardening table p 113.76 5e4 1e6 6e7 eps_vol_pl 0 0.593 1.083 1.514 beyond extrapolate";
  model.examples = {
      "density 200 d 5e3 beta 22.53 R 0.02 eps_vol_pl_0 0.3 "
      "elasticity linear E 13.79e6 nu 0.3" +
          snow + " interpolation linear",
      "density 200 d 5e3 beta 22.53 R 0.3 alpha 0.05 K 0.8 tension 2e3 "
      "eps_vol_pl_0 0.3 elasticity porous kappa 0.005 e0 3.5 p0 10 pt_el 1.5e4 nu 0.3" +
          snow + " interpolation log",
      "density 200 d 5e3 beta 22.53 R 0.3 K 0.7 section matsuoka_nakai eps_vol_pl_0 0.3 "
      "elasticity linear E 13.79e6 nu 0.3" +
          snow + " interpolation linear"};
  return model;
}

DruckerPragerCap::DruckerPragerCap(double density, const DruckerPragerCapParameters& parameters,
                                   double eps_vol_pl_0)
    : ElasticKernelLaw("drucker_prager_cap", density, parameters, plastic_strains(eps_vol_pl_0)) {}

double DruckerPragerCap::pb(double eps) const { return strength_at(parameters_.hardening, eps); }

double DruckerPragerCap::pa(double eps) const {
  return (pb(eps) - parameters_.R * parameters_.d) / (1.0 + parameters_.R * parameters_.tan_beta);
}

double DruckerPragerCap::shear_strength(double p, double eps) const {
  const double top = pa(eps);
  const double Q = parameters_.d + top * parameters_.tan_beta;
  const double radius = parameters_.alpha * Q;
  const double D = top - p;
  if (D < radius * parameters_.sin_beta)
    return parameters_.B * Q + std::sqrt(radius * radius - D * D);
  return parameters_.d + p * parameters_.tan_beta;
}

double DruckerPragerCap::strength(double p, double eps) const {
  const double top = pa(eps);
  const double Q = parameters_.d + top * parameters_.tan_beta;
  if (p < top) return p < -parameters_.cutoff ? 0.0 : shear_strength(p, eps);
  const double leg = parameters_.R * Q * parameters_.R * Q - (p - top) * (p - top);
  return parameters_.A / parameters_.R * std::sqrt(std::max(leg, 0.0));
}

double DruckerPragerCap::yield_function(const VectorX& state) const {
  const Invariants stress = invariants(stress_of(state));
  const double t = yield_measure(stress, parameters_.section);
  const double eps = state[eps_vol_pl];
  const double top = pa(eps);
  const double Q = parameters_.d + top * parameters_.tan_beta;
  const double D = stress.p - top;
  const double cut = -stress.p - parameters_.cutoff;
  if (D >= 0.0)
    return std::max(cut, std::hypot(D, parameters_.R * t / parameters_.A) - parameters_.R * Q);
  return std::max(cut, t - shear_strength(stress.p, eps));
}

double DruckerPragerCap::stress_scale(const VectorX& state) const {
  const double stress = std::max(pb(state[eps_vol_pl]), std::abs(invariants(stress_of(state)).p));
  return std::max(parameters_.d + stress, rounding_stress(state));
}

std::vector<Vector2> DruckerPragerCap::yield_surface(const VectorX& state,
                                                     std::size_t points) const {
  const double eps = state[eps_vol_pl];
  const double tip = pb(eps);
  const double start = -parameters_.cutoff;
  const double top = std::max(pa(eps), start);
  std::vector<Vector2> line;
  if (parameters_.cutoff < parameters_.d / parameters_.tan_beta) line.emplace_back(start, 0.0);
  const std::size_t half = std::max<std::size_t>(points / 2, 2);
  // straight to the top, denser near it where the transition is
  for (std::size_t i = 0; i < half; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(half);
    const double p = i == 0 ? start : top - (top - start) * (1.0 - share) * (1.0 - share);
    line.emplace_back(p, strength(p, eps));
  }
  for (std::size_t i = 0; i <= half; ++i) {  // by equal angles along the cap
    const double angle = 0.5 * pi * static_cast<double>(i) / static_cast<double>(half);
    const double p = i == half ? tip : top + (tip - top) * (1.0 - std::cos(angle));
    line.emplace_back(p, i == half ? 0.0 : strength(p, eps));
  }
  return line;
}

}  // namespace furrow
