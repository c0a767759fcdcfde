// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/ground/overburden.h"

#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

// logarithmic, of one level against the next: a material that needs more cannot carry the weight
constexpr double max_strain = 1.0;
constexpr int bisections = 60;

std::size_t layer_at(const TerrainParameters& parameters, double z, std::size_t patch) {
  double bottom = parameters.surface;
  const auto [first, last] = parameters.layers_of(patch);
  for (std::size_t n = first; n < last; ++n)
    if (z > (bottom -= parameters.layers[n].thickness)) return n;
  return last;
}

VectorX compressed(const Material& material, VectorX state, double strain) {
  Matrix3 gradient = Matrix3::Zero();
  gradient(2, 2) = std::expm1(-strain);
  material.update_point(gradient, state);
  return state;
}

/// The state after the confined compression that makes -sigma_zz equal to a stress [Pa], or the
/// same state if it carries that already.
VectorX loaded(const Material& material, const VectorX& state, double stress) {
  const auto carried = [&](double strain) {
    return -compressed(material, state, strain)[field::stress + 2];
  };
  if (-state[field::stress + 2] >= stress) return state;
  double low = 0.0, high = 1e-7;
  while (carried(high) < stress) {
    low = high;
    high *= 2.0;
    if (high > max_strain)
      throw InputError(fmt::format("law {}", material.name()),
                       fmt::format("cannot carry {:.4g} Pa of weight", stress),
                       "a law that stiffens in confined compression",
                       "check that E and the strengths are in Pa; else give the ground no gravity "
                       "and no surcharge, or another law");
  }
  for (int i = 0; i < bisections; ++i) {
    const double middle = 0.5 * (low + high);
    (carried(middle) < stress ? low : high) = middle;
  }
  return compressed(material, state, high);
}

}  // namespace

void find_overburden(const TerrainParameters& parameters, double surcharge,
                     std::vector<ParticleLevel>& levels, std::size_t patch) {
  double weight = surcharge;  // weight of surcharge and ground above [Pa]
  for (std::size_t n = 0; n < levels.size(); ++n) {
    ParticleLevel& level = levels[n];
    level.layer = layer_at(parameters, level.z, patch);
    const Material& material = *parameters.layers[level.layer].material;
    const bool continues = n > 0 && levels[n - 1].layer == level.layer;
    level.state = continues ? levels[n - 1].state : material.initial_state();
    if (!parameters.initial_stress) continue;
    // Half of the level's own weight counts; its density depends little on the last increment of
    // strain.
    const double g = -parameters.gravity.z();
    const double above = weight + g * material.current_density(level.state) * level.half;
    level.state = loaded(material, level.state, above);
    weight += 2.0 * g * material.current_density(level.state) * level.half;
  }
}

}  // namespace furrow
