// SPDX-License-Identifier: GPL-2.0-or-later
#include "material/models/crushable_foam/crushable_foam.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "material/elasticity/elasticity.h"
#include "material/hardening/hardening.h"
#include "material/kernels.h"

namespace furrow {

namespace {

std::unique_ptr<Material> create(const MaterialOptions& sections) {
  const Options& o = sections.at("law").options;
  CrushableFoamParameters law;
  law.elasticity = make_elasticity(sections.at("elasticity"));
  law.pt = o.number("pt");
  law.flow_ratio = o.number("K");
  const bool includes_pt = o.text("pc0_reading") == "pc0_plus_pt";
  const SectionOptions& hardening = sections.at("hardening");
  if (includes_pt && hardening.type != "exponential")
    throw InputError(o.where("pc0_reading"), "is pc0_plus_pt, with a hardening table",
                     "pc0 for a table, whose strengths are pc");
  law.hardening = make_hardening(hardening, law.pt, includes_pt);
  if (law.hardening.first > 0.0 || law.hardening.last < 0.0)
    throw InputError("hardening table, keyword 'eps_vol_pl'", "does not contain 0",
                     "a table around eps_vol_pl = 0, where pc0 is read");
  const double pc0 = strength_at(law.hardening, 0.0), sigma0 = o.number("sigma0");
  const double square = law.pt * pc0 + sigma0 * (pc0 - law.pt) / 3.0 -
                        sigma0 * sigma0 / 9.0;  // = (3 pc0 - sigma0)(sigma0 + 3 pt)/9
  if (square <= 0.0)
    throw InputError(
        o.where("sigma0"),
        fmt::format("is {}, which no ellipse through pc0 = {:.6g} Pa and pt reaches", sigma0, pc0),
        fmt::format("below 3 pc0 = {:.6g} Pa", 3.0 * pc0));
  law.M = sigma0 / std::sqrt(square);
  if (law.elasticity.porous && law.elasticity.limit <= law.pt)
    throw InputError("elasticity porous, keyword 'pt_el'",
                     fmt::format("is {} Pa", law.elasticity.limit),
                     fmt::format("above pt = {} Pa", law.pt),
                     "the pressure could not reach the tensile strength");
  return std::make_unique<CrushableFoam>(o.number("density"), law);
}

}  // namespace

MaterialModel CrushableFoam::law() {
  Schema schema("law crushable_foam");
  schema.number("density", "kg/m3", Range::positive(), "mass density at the start");
  schema.number("pt", "Pa", Range::positive(), "yield strength in hydrostatic tension, constant");
  schema.number("sigma0", "Pa", Range::positive(),
                "initial yield strength in uniaxial compression, below 3 pc0");
  schema
      .number("K", "", Range::closed(0.778, 1.0),
              "flow stress ratio, triaxial extension to compression")
      .by_default(1.0);
  schema
      .choice("pc0_reading", {"pc0", "pc0_plus_pt"},
              "what pc0 of exponential hardening is: pc0, or pc0 + pt")
      .by_default("pc0");
  return {"crushable_foam",
          "snow and foams: ellipse hardening by compaction (ABAQUS, TR eq 17-18)",
          {{"law", {{"", "", schema}}}, elasticity_section(), hardening_section()},
          create};
}

CrushableFoam::CrushableFoam(double density, const CrushableFoamParameters& parameters)
    : Material("crushable_foam", density,
               {{"eps_vol_pl", "", "volumetric plastic strain, compression positive", 0.0}},
               initial_pressure(parameters.elasticity)),
      parameters_(parameters) {}

UpdateReport CrushableFoam::update_block(const PointBlock& block) const {
  return checked(kernels().crushable_foam(parameters_, density(), block), block);
}

ElasticModuli CrushableFoam::moduli(const VectorX& state) const {
  return moduli_at(parameters_.elasticity, invariants(stress_of(state)).p);
}

double CrushableFoam::pc(double eps) const { return strength_at(parameters_.hardening, eps); }

double CrushableFoam::yield_function(const VectorX& state) const {
  const Invariants stress = invariants(stress_of(state));
  const double strength = pc(state[eps_vol_pl]), pt = parameters_.pt;
  const double t = yield_measure(stress, parameters_.flow_ratio);
  return std::hypot(stress.p - 0.5 * (strength - pt), t / parameters_.M) - 0.5 * (strength + pt);
}

double CrushableFoam::largest_wave_speed(const PointBlock& block) const {
  return largest_elastic_wave_speed(parameters_.elasticity, density(), block);
}

double CrushableFoam::stress_scale(const VectorX& state) const {
  const double stress = std::max(pc(state[eps_vol_pl]), std::abs(invariants(stress_of(state)).p));
  return std::max(parameters_.pt + stress, 1e-8 * moduli(state).wave());
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
