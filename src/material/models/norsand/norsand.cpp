// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/models/norsand/norsand.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/material/section/section.h"

namespace furrow {

namespace {

constexpr double usual_solid = 3000.0;    // [kg/m3] minerals
constexpr double largest_coupling = 0.9;  // of K M^2/(12 G (1 - N)), so that P(D) exists
constexpr double largest_slope = 0.8;     // of (1 - N) lambda chi/M, so that chi_i exists

std::unique_ptr<Material> create_norsand(const MaterialOptions& sections) {
  const Options& o = sections.at("law").options;
  NorSandParameters q;
  q.M = o.number("M");
  q.N = o.number("N");
  q.H = o.number("H");
  q.H_psi = o.number("H_psi");
  q.lambda = o.number("lambda");
  q.csl_exponent = o.number("csl_exponent");
  const bool straight = q.csl_exponent == 0.0;
  q.gamma = o.number("gamma") + (straight ? q.lambda * std::log(1e3) : 0.0);  // from 1 kPa to 1 Pa
  // At the peak psi_i = psi - lambda ln x, and ln x is nearly (1 - N) D/M; with an exponent the
  // slope over ln p is that at the reference pressure.
  const double chi = o.number("chi"),
               slope = (1.0 - q.N) * q.lambda * (straight ? 1.0 : q.csl_exponent) * chi / q.M;
  if (slope > largest_slope)
    throw InputError(o.where("chi"), fmt::format("is {:g}: too large for this lambda", chi),
                     fmt::format("at most {:.4g}", chi * largest_slope / slope),
                     "sands have chi 2 to 5, and lambda 0.01 to 0.05 over the natural logarithm");
  q.chi_i = chi / (1.0 - slope);
  const double nu = o.number("nu");
  q.shear = o.number("G");
  q.exponent = o.number("n");
  q.H_exponent = o.has("H_exponent") ? o.number("H_exponent") : 1.0 - q.exponent;
  q.bulk_ratio = 2.0 * (1.0 + nu) / (3.0 * (1.0 - 2.0 * nu));
  const double coupling = q.bulk_ratio * q.M * q.M / (12.0 * (1.0 - q.N));
  if (coupling > largest_coupling)
    throw InputError(
        o.where("nu"),
        fmt::format("is {:g}: with M and N, K M^2/(12 G (1 - N)) is {:.3g}", nu, coupling),
        fmt::format("at most {:g}", largest_coupling), "sands have nu 0.1 to 0.3");
  q.pt = o.number("pt");
  q.floor = 0.01 * q.pt;
  q.tip = std::pow(1.0 / (1.0 - q.N), (1.0 - q.N) / q.N);
  q.section = make_section(o);
  if (o.has("shear_band")) q.shear_band = o.number("shear_band");
  return std::make_unique<NorSand>(o.number("density"), q, o.number("e0"),
                                   o.has("image_pressure") ? o.number("image_pressure") : q.pt,
                                   o.has("band_width") ? o.number("band_width") : q.shear_band);
}

std::vector<std::string> norsand_warnings(const MaterialOptions& sections) {
  const Options& o = sections.at("law").options;
  const double density = o.number("density"), e0 = o.number("e0"), solid = density * (1.0 + e0);
  std::vector<std::string> sentences;
  if (solid > usual_solid)
    sentences.push_back(
        fmt::format("e0 is {:g} and the density {:g} kg/m3: without voids the ground would have "
                    "{:.4g} kg/m3, minerals have up to {:g}",
                    e0, density, solid, usual_solid));
  const double loosest =
      o.number("gamma") + o.number("M") / (1.0 - o.number("N")) / o.number("chi");
  if (e0 > loosest)
    sentences.push_back(fmt::format(
        "e0 is {:g}, above gamma + M/((1 - N) chi) = {:.3g}: so loose a ground bears no shear", e0,
        loosest));
  return sentences;
}

}  // namespace

MaterialModel NorSand::model() {
  Schema schema("law norsand");
  schema.number("density", "kg/m3", Range::positive(), "mass density at the start");
  schema.number("e0", "", Range::positive(), "void ratio at the start");
  schema.number("M", "", Range{0.0, 2.0, true, false},
                "critical stress ratio q/p in triaxial compression");
  schema.number("gamma", "", Range::positive(),
                "void ratio of the critical state at 1 kPa; with csl_exponent at zero pressure");
  schema.number("lambda", "", Range::non_negative(),
                "slope of the critical state line: decrease of the void ratio over ln p");
  schema
      .number("csl_exponent", "", Range::closed(0.0, 1.0),
              "0: line over ln p; else e = gamma - lambda (p/100 kPa)^csl_exponent")
      .by_default(0.0);
  schema.number("chi", "", Range::positive(),
                "dilatancy: the largest is chi times the state parameter, in triaxial compression");
  schema
      .number("N", "", Range::closed(0.05, 0.8),
              "volumetric coupling: the stress ratio is M - (1 - N) times the dilatancy")
      .by_default(0.5);
  schema.number("H", "", Range::positive(),
                "plastic hardening modulus over the image pressure, where that is 100 kPa");
  schema
      .number("H_exponent", "", Range::closed(0.0, 1.0),
              "H times (image pressure/100 kPa)^-H_exponent; 1 - n unless given")
      .optional();
  schema
      .number("H_psi", "", Range::non_negative(),
              "decrease of H with the state parameter; at least a tenth of H remains")
      .by_default(0.0);
  schema.number("G", "Pa", Range::positive(), "shear modulus at 100 kPa");
  schema.number("n", "", Range::closed(0.2, 1.0), "exponent of the shear modulus over pressure");
  schema.number("nu", "", Range{-1.0, 0.5, true, true}, "Poisson's ratio");
  schema.number("pt", "Pa", Range::positive(), "hydrostatic tensile strength").by_default(10.0);
  schema
      .number("image_pressure", "Pa", Range::positive(),
              "size of the yield surface at the start, from preloading; pt unless given")
      .optional();
  schema
      .number("shear_band", "m", Range{1e-4, 1.0, false, false},
              "width of a shear band, about 15 grains; that of the cell unless given")
      .optional();
  schema
      .number("band_width", "m", Range::positive(),
              "width that a single point stands for; shear_band unless given")
      .optional();
  declare_section(schema);
  MaterialModel model;
  model.name = "norsand";
  model.meaning =
      "sand that peaks and falls to the critical state (NorSand, Jefferies and Shuttle, 2005)";
  model.sections = {law_section(schema)};
  model.create = create_norsand;
  model.warnings = norsand_warnings;
  const std::string sand = " M 1.25 gamma 0.85 lambda 0.02 chi 3.5 N 0.5 H 100 G 40e6 n 0.5 nu 0.2";
  model.examples = {
      "density 1700 e0 0.6" + sand, "density 1450 e0 0.9" + sand + " H_psi 300 image_pressure 2e3",
      "density 1600 e0 0.7 pt 100 K 0.72 H_exponent 0.3 section matsuoka_nakai" + sand,
      "density 1700 e0 0.55 K 0.8 M 1.25 gamma 0.85 lambda 0.1 csl_exponent 0.7 chi "
      "3.5 N 0.3 H 100 "
      "G 40e6 n 0.4 nu 0.2",
      "density 1700 e0 0.6 shear_band 0.005 band_width 0.04" + sand};
  return model;
}

NorSand::NorSand(double density, const NorSandParameters& parameters, double void_ratio,
                 double image_pressure, double width)
    : KernelLaw("norsand", density, parameters,
                {{"void_ratio", "", "volume of voids over volume of grains", void_ratio},
                 {"image_pressure", "Pa", "size of the yield surface", image_pressure},
                 {"eps_dev_pl", "", "equivalent plastic strain, of the deviatoric part"},
                 {"band_width", "m", "width of the shear band that the point stands for", width}}) {
}

ElasticModuli NorSand::moduli(const VectorX& state) const {
  const double P = std::max(invariants(stress_of(state)).p + parameters_.pt, parameters_.floor);
  const double shear =
      parameters_.shear * std::pow(P / NorSandParameters::reference_pressure, parameters_.exponent);
  return {parameters_.bulk_ratio * shear, shear};
}

double NorSand::largest_wave_speed(const PointBlock& block) const {
  // G J is (P J^(1/n))^n: the power is taken only where an upper bound of its base is above the
  // largest base so far.
  const double* const volume = block.state[field::volume_ratio];
  const int whole = static_cast<int>(std::ceil(1.0 / parameters_.exponent));
  double largest = 0.0;
  for (std::size_t i = 0; i < block.size; ++i) {
    const double p = -(block.state[0][i] + block.state[1][i] + block.state[2][i]) / 3.0;
    const double P = std::max(p + parameters_.pt, parameters_.floor), J = volume[i];
    double bound = P;
    if (J > 1.0)
      for (int k = 0; k < whole; ++k) bound *= J;
    if (bound > largest) largest = std::max(largest, P * std::pow(J, 1.0 / parameters_.exponent));
  }
  const double shear = parameters_.shear * std::pow(largest / NorSandParameters::reference_pressure,
                                                    parameters_.exponent);
  return std::sqrt((parameters_.bulk_ratio + 4.0 / 3.0) * shear / density());
}

double NorSand::critical_void_ratio(double pressure) const {
  return parameters_.gamma -
         parameters_.lambda * (parameters_.csl_exponent > 0.0
                                   ? std::pow(pressure / NorSandParameters::reference_pressure,
                                              parameters_.csl_exponent)
                                   : std::log(pressure));
}

double NorSand::strength(double P, const VectorX& state) const {
  const double x = std::max(P, 0.0) / state[image_pressure], N = parameters_.N;
  const double psi = state[void_ratio] - critical_void_ratio(state[image_pressure]);
  const double limit = std::clamp(parameters_.chi_i * psi, -parameters_.M,
                                  NorSandParameters::loosest * parameters_.largest_D());
  const double D = std::max(parameters_.M / N * (std::pow(x, N / (1.0 - N)) - 1.0), limit);
  return std::max(0.0, parameters_.M - (1.0 - N) * D) * P;
}

double NorSand::yield_function(const VectorX& state) const {
  const Invariants stress = invariants(stress_of(state));
  return yield_measure(stress, parameters_.section) - strength(stress.p + parameters_.pt, state);
}

double NorSand::stress_scale(const VectorX& state) const {
  const double P = invariants(stress_of(state)).p + parameters_.pt;
  return std::max({P, parameters_.tip * state[image_pressure], rounding_stress(state)});
}

std::vector<Vector2> NorSand::yield_surface(const VectorX& state, std::size_t points) const {
  const double tip = parameters_.tip * state[image_pressure];
  const std::size_t pieces = std::max<std::size_t>(points, 3) - 1;
  std::vector<Vector2> line;
  for (std::size_t i = 0; i <= pieces; ++i) {
    const double P = tip * static_cast<double>(i) / static_cast<double>(pieces);
    line.emplace_back(P - parameters_.pt, strength(P, state));
  }
  return line;
}

}  // namespace furrow
