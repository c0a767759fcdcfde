// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/time_step_check.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "atom.h"
#include "core/communicator.h"
#include "core/error.h"
#include "coupling/liggghts/script.h"
#include "fix_property_global.h"
#include "modify.h"
#include "update.h"

namespace furrow::coupling {

namespace {

constexpr double step_recommended = 0.2;  // of the Rayleigh time

LAMMPS_NS::FixPropertyGlobal* property_of_types(LAMMPS_NS::LAMMPS& lammps, const char* name) {
  return static_cast<LAMMPS_NS::FixPropertyGlobal*>(lammps.modify->find_fix_property(
      name, "property/global", "peratomtype", lammps.atom->ntypes, 0, "furrow", false));
}

/// Largest number of two digits that is not above value.
double rounded_down(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::floor(value / unit) * unit;
}

}  // namespace

double rayleigh_time(double radius, double density, double young, double poisson) {
  const double shear = young / (2.0 * (1.0 + poisson));
  return M_PI * radius * std::sqrt(density / shear) / (0.1631 * poisson + 0.8766);
}

void check_time_step(LAMMPS_NS::LAMMPS& lammps, const std::string& where) {
  auto *young = property_of_types(lammps, "youngsModulus"),
       *poisson = property_of_types(lammps, "poissonsRatio");
  if (!young || !poisson) return;

  const LAMMPS_NS::Atom& atom = *lammps.atom;
  double shortest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < atom.nlocal; ++i) {
    const auto type = atom.type[i] - 1;
    shortest =
        std::min(shortest, rayleigh_time(atom.radius[i], atom.density[i], young->get_values()[type],
                                         poisson->get_values()[type]));
  }
  shortest = -Communicator(&lammps.world).max(-shortest);
  if (std::isinf(shortest)) return;

  if (!(shortest > 0.0))
    throw StateError(where +
                     ": a grain has a diameter or a density of 0, or no stiffness; write 'set "
                     "group all diameter "
                     "<m> density <kg/m3>' with numbers above 0");

  const double step = lammps.update->dt;
  const double share = step / shortest;
  if (share <= step_warning) return;
  const std::string finding = fmt::format(
      "{}: timestep {:.4g} s is {:.3g} of the Rayleigh time of the smallest, lightest or stiffest "
      "grain, {:.4g} s",
      where, step, share, shortest);
  const std::string remedy = fmt::format("write 'timestep {:.2g}' or less, or lower youngsModulus",
                                         rounded_down(step_recommended * shortest));
  if (!(share <= step_limit))
    throw StateError(fmt::format("{} (limit {:g}); {}", finding, step_limit, remedy));
  warn(lammps, fmt::format("{} (recommended: at most {:g}); {}", finding, step_warning, remedy));
}

}  // namespace furrow::coupling
