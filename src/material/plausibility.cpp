// SPDX-License-Identifier: GPL-2.0-or-later
#include "material/plausibility.h"

#include <cmath>

#include <fmt/format.h>

#include "core/options.h"

namespace furrow {

namespace {

// What can be (air; osmium), and what ground and rubber are (the lightest fresh snow; ore) [kg/m3]
const Range possible_density = Range::closed(1e-3, 23e3), usual_density = Range::closed(10, 3000);
// Compression waves at rest (diamond: 18 km/s) [m/s]; loose ground is slow where it bears nothing
const Range possible_speed = Range::closed(1e-3, 3e4), usual_speed = Range::closed(1, 8000);
// Bulk over shear modulus; round-off of the pressure grows with it
const Range possible_ratio = Range::closed(1e-3, 1e4);

constexpr char units[] = "units are SI: kg/m3 and Pa";

double wave_speed(const Material& material) {
  return std::sqrt(material.moduli(material.initial_state()).wave() / material.density());
}

double poisson(double ratio) { return (3.0 * ratio - 2.0) / (2.0 * (3.0 * ratio + 1.0)); }

}  // namespace

void check_plausible(const Material& material) {
  const std::string where = fmt::format("law {}", material.name());
  if (!possible_density.contains(material.density()))
    throw InputError(where, fmt::format("has a density of {:.6g} kg/m3", material.density()),
                     fmt::format("a number {}", possible_density.text()), units);
  const ElasticModuli moduli = material.moduli(material.initial_state());
  const double ratio = moduli.bulk / moduli.shear;
  if (moduli.shear > 0.0 && std::isfinite(ratio) && !possible_ratio.contains(ratio))
    throw InputError(
        where,
        fmt::format(
            "has a bulk modulus of {:.3g} times its shear modulus (Poisson's ratio {:.10g})", ratio,
            poisson(ratio)),
        fmt::format("a ratio {}: Poisson's ratio in [{:.4g}, {:.6g}], beyond which round-off hides "
                    "the stress",
                    possible_ratio.text(), poisson(possible_ratio.lower),
                    poisson(possible_ratio.upper)),
        "nearly incompressible ground has 0.49");
  const double speed = wave_speed(material);
  if (!possible_speed.contains(speed))
    throw InputError(
        where,
        fmt::format("has a stiffness at rest of {:.3g} Pa and a density of {:.6g} kg/m3: "
                    "compression waves of {:.3g} m/s",
                    moduli.wave(), material.density(), speed),
        fmt::format("a speed {} [m/s]", possible_speed.text()), units);
}

std::vector<std::string> doubts(const Material& material) {
  std::vector<std::string> sentences;
  if (!usual_density.contains(material.density()))
    sentences.push_back(
        fmt::format("the density is {:.6g} kg/m3; ground and rubber have one {} (fresh snow 10 to "
                    "200, sand 1500, solid rock 2700); {}",
                    material.density(), usual_density.text(), units));
  const double speed = wave_speed(material);
  if (!usual_speed.contains(speed))
    sentences.push_back(fmt::format(
        "compression waves have {:.3g} m/s at rest (modulus {:.3g} Pa, density {:.6g} kg/m3); "
        "ground and rubber have a speed {} (fresh snow 100 to 300, sand 200, rock 5000); {}",
        speed, material.moduli(material.initial_state()).wave(), material.density(),
        usual_speed.text(), units));
  return sentences;
}

}  // namespace furrow
