// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/models/undrained_clay/undrained_clay.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

std::unique_ptr<Material> create_undrained_clay(const MaterialOptions& sections) {
  const Options& o = sections.at("law").options;
  UndrainedClayParameters parameters;
  parameters.elasticity = make_elasticity(sections.at("elasticity"));
  require_linear(parameters.elasticity, "undrained_clay",
                 "the stiffness of clay without drainage is a multiple of su");
  const double su = o.number("su"), width = o.number("band_width"), slip = o.number("slip_95");
  parameters.q = std::sqrt(3.0) * su;
  parameters.remoulded = 1.0 / o.number("sensitivity");
  parameters.decay = 3.0 * std::sqrt(3.0) / slip;
  parameters.rate_gain = o.number("rate_share") / std::log(10.0);
  parameters.reference_rate = o.number("reference_rate");
  const double least =
      3.0 * su * (1.0 - parameters.remoulded) * width / parameters.elasticity.shear;
  if (slip < least)
    throw InputError(
        o.where("slip_95"),
        fmt::format("is {:g} m: a band of {:g} m would soften faster than it unloads", slip, width),
        fmt::format("at least {:.4g} m", least), "or make band_width smaller");
  return std::make_unique<UndrainedClay>(o.number("density"), parameters, width);
}

}  // namespace

MaterialModel UndrainedClay::model() {
  Schema schema("law undrained_clay");
  schema.number("density", "kg/m3", Range::positive(), "mass density at the start");
  schema.number(
      "su", "Pa", Range{0.0, 1e7, true, false},
      "undrained strength in simple shear and plane strain, intact, at the reference rate");
  schema
      .number("rate_share", "", Range::closed(0.0, 1.0),
              "gain of strength for ten times the rate of shear, over su")
      .by_default(0.0);
  schema
      .number("reference_rate", "1/s", Range::positive(),
              "rate of shear strain up to which the strength is su")
      .by_default(1.0);
  schema.number("sensitivity", "", Range::closed(1.0, 1000.0), "intact over remoulded strength")
      .by_default(1.0);
  schema
      .number("slip_95", "m", Range::positive(),
              "slip across a shear band that completes 95 % of the remoulding")
      .by_default(0.1);
  schema
      .number("band_width", "m", Range::positive(),
              "width of the shear band of a single point; a continuum takes its cells")
      .by_default(0.02);
  MaterialModel model;
  model.name = "undrained_clay";
  model.meaning = "clay without drainage: cohesion with rate effect and sensitivity";
  model.sections = {law_section(schema), elasticity_section()};
  model.create = create_undrained_clay;
  const std::string clay = "density 1800 su 2e3 elasticity linear E 5e6 nu 0.3";
  model.examples = {"density 1800 su 5e3 elasticity linear E 5e6 nu 0.45",
                    clay + " sensitivity 4 slip_95 0.01 band_width 0.1",
                    clay + " rate_share 0.1 reference_rate 1e-5",
                    clay + " rate_share 0.2 reference_rate 1e-3 sensitivity 2 slip_95 0.01"};
  return model;
}

UndrainedClay::UndrainedClay(double density, const UndrainedClayParameters& parameters,
                             double width)
    : ElasticKernelLaw(
          "undrained_clay", density, parameters,
          {{"eps_dev_pl", "", "equivalent plastic strain, of the deviatoric part"},
           {"band_width", "m", "width of the shear band that the point stands for", width}}) {}

double UndrainedClay::strength(const VectorX& state) const {
  const double kept = std::exp(-parameters_.decay * state[band_width] * state[eps_dev_pl]);
  return parameters_.q * (parameters_.remoulded + (1.0 - parameters_.remoulded) * kept);
}

double UndrainedClay::yield_function(const VectorX& state) const {
  return invariants(stress_of(state)).q - strength(state);
}

double UndrainedClay::stress_scale(const VectorX& state) const {
  return std::max(strength(state) + std::abs(invariants(stress_of(state)).p),
                  rounding_stress(state));
}

std::vector<Vector2> UndrainedClay::yield_surface(const VectorX& state, std::size_t points) const {
  const double end = 10.0 * stress_scale(state), q = strength(state);
  std::vector<Vector2> line;
  for (std::size_t i = 0; i < points; ++i)
    line.emplace_back(end * (2.0 * static_cast<double>(i) / static_cast<double>(points - 1) - 1.0),
                      q);
  return line;
}

}  // namespace furrow
