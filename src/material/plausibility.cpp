// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/plausibility.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/options/options.h"
#include "furrow/material/elasticity/elasticity.h"
#include "furrow/material/hardening/hardening.h"

namespace furrow {

namespace {

// Air to osmium, and minerals without voids [kg/m3]
const Range possible_density = Range::closed(1e-3, 23e3);
constexpr double solid_density = 3000.0;
// Compression waves at rest [m/s]; diamond has 18 km/s
const Range possible_speed = Range::closed(1e-3, 3e4);
// Compression waves in ground that bears a wheel [m/s]: peat and very soft clay of 0.2 MPa have 14,
// snow 100 to 1000, ice and frozen soil 4000, rock 6000 [Mellor1977, Bowles1996 Tables 2-7 and 2-8]
constexpr double usual_pressure = 1e4;  // [Pa]
const Range usual_speed = Range::closed(10, 4500), usual_rock_speed = Range::closed(10, 8000);
constexpr double rock_density = 2000;  // [kg/m3]
// Bulk over shear modulus; round-off of the pressure grows with it
const Range possible_ratio = Range::closed(1e-3, 1e4);

// Hydrostatic yield strengths [Pa]. Snow of 200 kg/m3 has 100 Pa to 10 kPa, of 500 kg/m3 some
// 100 kPa, ice 10 MPa, rock up to 500 MPa [Mellor1977, Abele1975, Shoop2001]: the upper bound grows
// tenfold every 200 kg/m3.
constexpr double usual_last_strength = 5e3, usual_dense_strength = 1e4;
constexpr double dense_ground = 500.0;  // [kg/m3]
double largest_strength(double density) {
  return std::min(1e5 * std::pow(10.0, (density - 200.0) / 200.0), 1e9);
}
// Strength over bulk modulus: ground yields after an elastic compaction of 1e-5 to 1e-2. Constant
// moduli that were measured on loose ground are too low at the end of a table, by up to this.
constexpr double largest_first_ratio = 0.1, largest_last_ratio = 10.0, smallest_last_ratio = 1e-4;

constexpr char units[] = "units are SI: kg/m3 and Pa";

double wave_speed(const Material& material, double pressure = 0.0) {
  VectorX state = material.initial_state();
  state.segment<3>(field::stress).array() -= pressure;
  return std::sqrt(material.moduli(state).wave() / material.density());
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

std::vector<std::string> plausibility_warnings(const Material& material) {
  std::vector<std::string> sentences;
  const double speed = wave_speed(material, usual_pressure);
  const Range& usual = material.density() < rock_density ? usual_speed : usual_rock_speed;
  if (!usual.contains(speed))
    sentences.push_back(fmt::format(
        "compression waves have {:.3g} m/s at a pressure of 10 kPa (density {:.6g} kg/m3); ground "
        "and rubber have a speed {} (fresh snow 100 to 300, sand 200, rock 5000); {}",
        speed, material.density(), usual.text(), units));
  return sentences;
}

namespace {

/// A strength of the hardening [Pa], and the density that has it [kg/m3].
struct Strength {
  double density, p;
};

double compaction_at_start(const Options& law) {
  return law.has("eps_vol_pl_0") ? law.number("eps_vol_pl_0") : 0.0;
}

/// Rows of a table, or the start of the exponential law.
std::vector<Strength> given_strengths(const Options& law, const SectionOptions& hardening) {
  const double density = law.number("density");
  const Options& o = hardening.options;
  if (hardening.type == "exponential") return {{density, o.number("pc0")}};
  const bool by_density = hardening.type == "by_density";
  const std::vector<double>& column = o.numbers(by_density ? "rho" : "eps_vol_pl");
  std::vector<Strength> rows;
  for (std::size_t n = 0; n < column.size(); ++n)
    rows.push_back(
        {by_density ? column[n] : density * std::exp(column[n] - compaction_at_start(law)),
         o.numbers("p")[n]});
  return rows;
}

/// Strength of the densest state: the last row of a table, or no voids for the exponential law.
Strength densest(const Options& law, const SectionOptions& hardening,
                 const HardeningParameters& curve) {
  if (hardening.type != "exponential") return given_strengths(law, hardening).back();
  const double solid_over_density = 1.0 + hardening.options.number("e0");
  return {law.number("density") * solid_over_density,
          strength_at(curve, std::log(solid_over_density))};
}

/// Percent for a void ratio or for strains.
void warn_of_densities(const MaterialOptions& sections, std::vector<std::string>& sentences) {
  const double density = sections.at("law").options.number("density");
  for (const char* name : {"elasticity", "hardening"}) {
    const auto section = sections.find(name);
    if (section == sections.end() || !section->second.options.has("e0")) continue;
    const double e0 = section->second.options.number("e0"), solid = density * (1.0 + e0);
    if (solid > solid_density)
      sentences.push_back(fmt::format(
          "e0 is {:g} in {}: without voids the ground would have {:.4g} kg/m3, minerals "
          "have up to {:g}; give e0 as a ratio, not in percent",
          e0, name, solid, solid_density));
  }
  const auto hardening = sections.find("hardening");
  if (hardening == sections.end() || hardening->second.type != "table") return;
  const double last = given_strengths(sections.at("law").options, hardening->second).back().density;
  if (last > solid_density)
    sentences.push_back(
        fmt::format("the hardening ends at eps_vol_pl = {:g}, a density of {:.4g} kg/m3; minerals "
                    "have up to {:g}; give strains as fractions, not in percent",
                    hardening->second.options.numbers("eps_vol_pl").back(), last, solid_density));
}

/// Warns of strengths in kPa or mPa in the place of Pa.
void warn_of_strengths(const MaterialOptions& sections, std::vector<std::string>& sentences) {
  const auto found = sections.find("hardening");
  if (found == sections.end()) return;
  const SectionOptions& hardening = found->second;
  const Options& law = sections.at("law").options;
  const bool table = hardening.type != "exponential";
  const HardeningParameters curve = make_hardening(hardening, law.number("density"));
  const Strength last = densest(law, hardening, curve);
  const double usual = last.density < dense_ground ? usual_last_strength : usual_dense_strength;
  if (last.p < usual)
    sentences.push_back(
        fmt::format("the hardening ends with p = {:g} Pa at {:.4g} kg/m3; ground of that density "
                    "has a strength of at least {:g} Pa; give Pa, not kPa",
                    last.p, last.density, usual));
  for (const Strength& row : given_strengths(law, hardening)) {
    const double largest = largest_strength(row.density);
    if (row.p <= largest) continue;
    sentences.push_back(
        fmt::format("the hardening has {} = {:g} Pa at {:.4g} kg/m3; ground of that density has a "
                    "strength of at most {:.2g} Pa; give Pa, not mPa",
                    table ? "p" : "pc0", row.p, row.density, largest));
    break;
  }
  const auto elasticity = sections.find("elasticity");
  if (elasticity == sections.end() || elasticity->second.type != "linear") return;
  const double bulk = make_elasticity(elasticity->second).bulk;
  const double first = strength_at(curve, compaction_at_start(law)) / bulk;
  const double end = last.p / bulk;
  if (first > largest_first_ratio || (table && end > largest_last_ratio))
    sentences.push_back(fmt::format(
        "the hardening {} with {:.3g} times the bulk modulus of the elasticity, {:.3g} "
        "Pa; ground has at most {:g} times; give E and the strengths in Pa, not E in "
        "kPa or strengths in mPa",
        first > largest_first_ratio ? "begins" : "ends", first > largest_first_ratio ? first : end,
        bulk, first > largest_first_ratio ? largest_first_ratio : largest_last_ratio));
  if (table && end < smallest_last_ratio && last.p >= usual)
    sentences.push_back(fmt::format(
        "the hardening ends with p = {:g} Pa, and the bulk modulus of the elasticity is "
        "{:.3g} times that; ground has at most {:g} times; give E and the strengths in "
        "Pa, not E in mPa or strengths in kPa",
        last.p, 1.0 / end, 1.0 / smallest_last_ratio));
}

/// Porous elasticity and exponential hardening are one compression line, with its unloading.
void warn_of_compression_line(const MaterialOptions& sections,
                              std::vector<std::string>& sentences) {
  const auto elasticity = sections.find("elasticity"), hardening = sections.find("hardening");
  if (elasticity == sections.end() || hardening == sections.end() ||
      elasticity->second.type != "porous" || hardening->second.type != "exponential")
    return;
  for (const char* key : {"kappa", "e0"}) {
    const double elastic = elasticity->second.options.number(key),
                 plastic = hardening->second.options.number(key);
    if (elastic != plastic)
      sentences.push_back(
          fmt::format("{} is {:g} in elasticity and {:g} in hardening: one "
                      "compression line has one; write the same",
                      key, elastic, plastic));
  }
}

}  // namespace

std::vector<std::string> plausibility_warnings(const MaterialOptions& sections) {
  std::vector<std::string> sentences;
  warn_of_compression_line(sections, sentences);
  warn_of_densities(sections, sentences);
  warn_of_strengths(sections, sentences);
  return sentences;
}

}  // namespace furrow
