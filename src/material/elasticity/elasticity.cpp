// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/elasticity/elasticity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

// (1 + e0)/kappa, of peat and of rock by wide margins
const Range possible_stiffness = Range::closed(1.0, 1e6);

}  // namespace

SectionSchema elasticity_section() {
  const Range poisson{-1.0, 0.5, true, true};
  Schema linear("elasticity linear");
  linear.number("E", "Pa", Range::positive(), "Young's modulus");
  linear.number("nu", "", poisson, "Poisson's ratio");
  Schema porous("elasticity porous");
  porous.number("kappa", "", Range::positive(),
                "logarithmic bulk modulus: slope of void ratio against ln p in unloading");
  porous.number("e0", "", Range::positive(), "initial void ratio");
  porous.number("p0", "Pa", Range::non_negative(), "initial pressure, where J_el = 1")
      .by_default(0.0);
  porous
      .number("pt_el", "Pa", Range::non_negative(),
              "tensile limit: the pressure stays above -pt_el")
      .by_default(0.0);
  porous
      .number("nu", "", poisson,
              "Poisson's ratio, with G from the bulk modulus at the start of a step")
      .optional();
  porous.number("G", "Pa", Range::positive(), "constant shear modulus, instead of nu").optional();
  return {"elasticity",
          {{"linear", "constant Young's modulus and Poisson's ratio", linear},
           {"porous", "bulk modulus proportional to pressure", porous}}};
}

ElasticityParameters make_elasticity(const SectionOptions& section) {
  const Options& o = section.options;
  ElasticityParameters e;
  if (section.type == "linear") {
    e.bulk = o.number("E") / (3.0 * (1.0 - 2.0 * o.number("nu")));
    e.shear = o.number("E") / (2.0 * (1.0 + o.number("nu")));
    return e;
  }
  e.porous = true;
  e.stiffness = (1.0 + o.number("e0")) / o.number("kappa");
  if (!possible_stiffness.contains(e.stiffness))
    throw InputError(o.where("kappa"),
                     fmt::format("is {:g} and e0 {:g}: a bulk modulus of {:.3g} times the pressure",
                                 o.number("kappa"), o.number("e0"), e.stiffness),
                     fmt::format("(1 + e0)/kappa {}", possible_stiffness.text()),
                     "snow and soils have kappa 0.001 to 0.3, e0 0.3 to 10");
  e.p0 = o.number("p0");
  e.limit = o.number("pt_el");
  if (e.p0 + e.limit <= 0.0)
    throw InputError(o.where("p0"), "and 'pt_el' are both 0: the bulk modulus would be 0",
                     "p0 + pt_el > 0 [Pa]");
  e.resolution = std::numeric_limits<double>::epsilon() * (e.p0 + e.limit);
  if (o.has("nu") == o.has("G"))
    throw InputError(o.subject(),
                     o.has("nu") ? "has both 'nu' and 'G'" : "has neither 'nu' nor 'G'",
                     "exactly one of nu, G");
  if (o.has("G")) {
    e.shear = o.number("G");
  } else {
    const double nu = o.number("nu");
    e.shear_ratio = 3.0 * (1.0 - 2.0 * nu) / (2.0 * (1.0 + nu));
  }
  return e;
}

void check_reaches_tension(const ElasticityParameters& parameters, double tensile) {
  if (parameters.porous && parameters.limit <= tensile)
    throw InputError("elasticity porous, keyword 'pt_el'",
                     fmt::format("is {} Pa", parameters.limit),
                     fmt::format("above the tensile strength at the start, {:.6g} Pa", tensile),
                     "the pressure could not reach it");
}

void require_linear(const ElasticityParameters& parameters, const std::string& law,
                    const std::string& remedy) {
  if (parameters.porous)
    throw InputError(fmt::format("law {}, section 'elasticity', keyword 'type'", law), "is porous",
                     "linear", remedy);
}

double initial_pressure(const ElasticityParameters& parameters) {
  return parameters.porous ? parameters.p0 : 0.0;
}

std::vector<StateVariable> plastic_strains(double eps_vol_pl_0) {
  return {{"eps_vol_pl", "", "volumetric plastic strain, compression positive", eps_vol_pl_0},
          {"eps_dev_pl", "", "equivalent plastic strain, of the deviatoric part"}};
}

ElasticModuli moduli_at(const ElasticityParameters& e, double p) {
  if (!e.porous) return {e.bulk, e.shear};
  const double above_limit = std::max(p + e.limit, e.resolution);
  const double ratio = 1.0 - std::log(above_limit / (e.p0 + e.limit)) / e.stiffness;
  const double bulk = above_limit * e.stiffness * ratio;
  return {bulk, e.shear_ratio > 0.0 ? e.shear_ratio * bulk : e.shear};
}

double largest_elastic_wave_speed(const ElasticityParameters& e, double density,
                                  const PointBlock& block) {
  const double* const volume = block.state[field::volume_ratio];
  double largest = 0.0;  // of modulus times J
  if (!e.porous) {
    for (std::size_t i = 0; i < block.size; ++i) largest = std::max(largest, volume[i]);
    largest *= moduli_at(e, 0.0).wave();
  } else {
    for (std::size_t i = 0; i < block.size; ++i) {
      const double p = -(block.state[0][i] + block.state[1][i] + block.state[2][i]) / 3.0;
      largest = std::max(largest, moduli_at(e, p).wave() * volume[i]);
    }
  }
  return std::sqrt(largest / density);
}

}  // namespace furrow
