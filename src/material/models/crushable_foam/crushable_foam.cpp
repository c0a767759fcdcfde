// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/models/crushable_foam/crushable_foam.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/material/hardening/hardening.h"
#include "furrow/material/section/section.h"

namespace furrow {

namespace {

std::unique_ptr<Material> create_crushable_foam(const MaterialOptions& sections) {
  const Options& o = sections.at("law").options;
  CrushableFoamParameters parameters;
  parameters.elasticity = make_elasticity(sections.at("elasticity"));
  parameters.pt = o.number("pt");
  parameters.section = make_section(o);
  const bool includes_pt = o.text("pc0_reading") == "pc0_plus_pt";
  const SectionOptions& hardening = sections.at("hardening");
  if (includes_pt && hardening.type != "exponential")
    throw InputError(o.where("pc0_reading"), "is pc0_plus_pt, with a hardening table",
                     "pc0 for a table, whose strengths are pc");
  parameters.hardening = make_hardening(hardening, o.number("density"), parameters.pt, includes_pt);
  if (parameters.hardening.first > 0.0 || parameters.hardening.last < 0.0)
    throw InputError("hardening table, keyword 'eps_vol_pl'", "does not contain 0",
                     "a table around eps_vol_pl = 0, where pc0 is read");
  const double pc0 = strength_at(parameters.hardening, 0.0), sigma0 = o.number("sigma0");
  const double square = parameters.pt * pc0 + sigma0 * (pc0 - parameters.pt) / 3.0 -
                        sigma0 * sigma0 / 9.0;  // = (3 pc0 - sigma0)(sigma0 + 3 pt)/9
  if (square <= 0.0)
    throw InputError(
        o.where("sigma0"),
        fmt::format("is {}, which no ellipse through pc0 = {:.6g} Pa and pt reaches", sigma0, pc0),
        fmt::format("below 3 pc0 = {:.6g} Pa", 3.0 * pc0));
  parameters.M = sigma0 / std::sqrt(square);
  if (parameters.elasticity.porous && parameters.elasticity.limit <= parameters.pt)
    throw InputError("elasticity porous, keyword 'pt_el'",
                     fmt::format("is {} Pa", parameters.elasticity.limit),
                     fmt::format("above pt = {} Pa", parameters.pt),
                     "the pressure could not reach the tensile strength");
  return std::make_unique<CrushableFoam>(o.number("density"), parameters);
}

// Usual range of sigma0 over pc0. Above, M is nearly singular; below, the foam would carry a
// pressure from all sides that is many times what crushes it from one.
const Range usual_sigma0 = Range::closed(0.3, 2.8);

/// Warnings about sections that belong to two foams, or have another unit.
std::vector<std::string> foam_warnings(const MaterialOptions& sections) {
  const std::unique_ptr<Material> material = create_crushable_foam(sections);
  const double pc0 = static_cast<const CrushableFoam&>(*material).pc(0.0);
  const Options& law = sections.at("law").options;
  const double sigma0 = law.number("sigma0"), pt = law.number("pt");
  std::vector<std::string> sentences;
  if (!usual_sigma0.contains(sigma0 / pc0))
    sentences.push_back(
        fmt::format("sigma0 is {:g} Pa in law, and the hardening begins at pc0 = {:.6g} Pa: "
                    "sigma0/pc0 is {:.3g}, usual is a number {}; the sections hardly belong to one "
                    "material",
                    sigma0, pc0, sigma0 / pc0, usual_sigma0.text()));
  if (pt > pc0)
    sentences.push_back(
        fmt::format("pt is {:g} Pa in law, above pc0 = {:.6g} Pa of the hardening: stronger in "
                    "tension than in compression; the sections hardly belong to one material",
                    pt, pc0));
  return sentences;
}

}  // namespace

MaterialModel CrushableFoam::model() {
  Schema schema("law crushable_foam");
  schema.number("density", "kg/m3", Range::positive(), "mass density at the start");
  schema.number("pt", "Pa", Range::positive(), "yield strength in hydrostatic tension, constant");
  schema.number("sigma0", "Pa", Range::positive(),
                "initial yield strength in uniaxial compression, below 3 pc0");
  declare_section(schema);
  schema
      .choice("pc0_reading", {"pc0", "pc0_plus_pt"},
              "what pc0 of exponential hardening is: pc0, or pc0 + pt")
      .by_default("pc0");
  MaterialModel model;
  model.name = "crushable_foam";
  model.meaning = "snow and foams: ellipse hardening by compaction (ABAQUS, [Shoop2001] eq 17-18)";
  model.sections = {law_section(schema), elasticity_section(), hardening_section()};
  model.create = create_crushable_foam;
  model.warnings = foam_warnings;
  model.examples = {
      "density 200 pt 11.376 sigma0 275.79 K 0.9 "
      "elasticity porous elasticity.kappa 0.005 elasticity.e0 3.5 pt_el 113.76 nu 0.3 "
      "hardening exponential pc0 113.76 lambda 0.35 hardening.kappa 0.005 hardening.e0 3.5"};
  return model;
}

CrushableFoam::CrushableFoam(double density, const CrushableFoamParameters& parameters)
    : ElasticKernelLaw("crushable_foam", density, parameters, plastic_strains()) {}

double CrushableFoam::pc(double eps) const { return strength_at(parameters_.hardening, eps); }

double CrushableFoam::yield_function(const VectorX& state) const {
  const Invariants stress = invariants(stress_of(state));
  const double strength = pc(state[eps_vol_pl]);
  const double pt = parameters_.pt;
  const double t = yield_measure(stress, parameters_.section);
  return std::hypot(stress.p - 0.5 * (strength - pt), t / parameters_.M) - 0.5 * (strength + pt);
}

double CrushableFoam::stress_scale(const VectorX& state) const {
  const double stress = std::max(pc(state[eps_vol_pl]), std::abs(invariants(stress_of(state)).p));
  return std::max(parameters_.pt + stress, rounding_stress(state));
}

std::vector<Vector2> CrushableFoam::yield_surface(const VectorX& state, std::size_t points) const {
  const double strength = pc(state[eps_vol_pl]), centre = 0.5 * (strength - parameters_.pt),
               radius = 0.5 * (strength + parameters_.pt);
  const std::size_t pieces = std::max<std::size_t>(points, 3) - 1;
  std::vector<Vector2> line;
  for (std::size_t i = 0; i <= pieces; ++i) {
    const double angle = pi * (1.0 - static_cast<double>(i) / static_cast<double>(pieces));
    line.emplace_back(centre + radius * std::cos(angle), parameters_.M * radius * std::sin(angle));
  }
  return line;
}

}  // namespace furrow
