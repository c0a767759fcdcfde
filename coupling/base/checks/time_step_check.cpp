// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/base/checks/time_step_check.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "atom.h"
#include "furrow/core/communicator.h"
#include "coupling/liggghts/data/global_properties.h"
#include "fix_property_global.h"
#include "update.h"

namespace furrow::coupling {

namespace {

constexpr double step_recommended = 0.2;  // of the Rayleigh time

/// Largest number of two digits that is not above value.
double rounded_down(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::floor(value / unit) * unit;
}

/// Time to which a step is compared.
struct Measure {
  const char* what;  // "the Rayleigh time"
  double warning, limit, recommended;
  const char* stiffness;  // the property that makes it short
};
constexpr Measure rayleigh = {"the Rayleigh time", step_warning, step_limit, step_recommended,
                              "youngsModulus"};
constexpr Measure snow = {"the contact time", snow_step_warning, snow_step_limit, snow_step_warning,
                          "snowModulus"};

/// The shortest time of all grains. Collective.
template <class TimeOfGrain>
double shortest_time(const LAMMPS_NS::LAMMPS& lammps, TimeOfGrain&& time_of_grain) {
  double shortest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < lammps.atom->nlocal; ++i) shortest = std::min(shortest, time_of_grain(i));
  return -Communicator(&lammps.world).max(-shortest);
}

std::optional<Finding> compare(double step, double shortest, const Measure& measure,
                               const std::string& where) {
  if (std::isinf(shortest)) return {};  // scene without grains
  if (!(shortest > 0.0))
    return Finding{where +
                       ": a grain has a diameter or a density of 0, or no stiffness; write 'set "
                       "group all diameter <m> density <kg/m3>' with numbers above 0",
                   true};
  const double share = step / shortest;
  if (share <= measure.warning) return {};
  const std::string finding = fmt::format(
      "{}: timestep {:.4g} s is {:.3g} of {} of the smallest, lightest or stiffest grain, {:.4g} s",
      where, step, share, measure.what, shortest);
  const std::string remedy =
      fmt::format("write 'timestep {:.2g}' or less, or lower {}",
                  rounded_down(measure.recommended * shortest), measure.stiffness);
  if (!(share <= measure.limit))
    return Finding{fmt::format("{} (limit {:g}); {}", finding, measure.limit, remedy), true};
  return warning(
      fmt::format("{} (recommended: at most {:g}); {}", finding, measure.warning, remedy));
}

}  // namespace

double snow_contact_time(double radius, double density, double modulus) {
  return 2.0 * radius * std::sqrt(M_PI / 6.0 * density / modulus);
}

std::optional<Finding> check_snow_time_step(const LAMMPS_NS::LAMMPS& lammps,
                                            const std::string& where,
                                            const std::function<double(int type)>& modulus) {
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  const double shortest = shortest_time(lammps, [&](int i) {
    return snow_contact_time(atom.radius[i], atom.density[i], modulus(atom.type[i]));
  });
  return compare(lammps.update->dt, shortest, snow, where);
}

double rayleigh_time(double radius, double density, double young, double poisson) {
  const double shear = young / (2.0 * (1.0 + poisson));
  return M_PI * radius * std::sqrt(density / shear) / (0.1631 * poisson + 0.8766);
}

std::optional<Finding> check_time_step(LAMMPS_NS::LAMMPS& lammps, const std::string& where) {
  auto *young = property_of_types(lammps, "youngsModulus"),
       *poisson = property_of_types(lammps, "poissonsRatio");
  if (!young || !poisson) return {};

  const LAMMPS_NS::Atom& atom = *lammps.atom;
  const double shortest = shortest_time(lammps, [&](int i) {
    const auto type = atom.type[i] - 1;
    return rayleigh_time(atom.radius[i], atom.density[i], young->get_values()[type],
                         poisson->get_values()[type]);
  });
  return compare(lammps.update->dt, shortest, rayleigh, where);
}

}  // namespace furrow::coupling
