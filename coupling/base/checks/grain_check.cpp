// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/base/checks/grain_check.h"

#include <string>

#include <fmt/format.h>

#include "atom.h"
#include "furrow/core/error.h"
#include "furrow/core/types.h"
#include "update.h"

namespace furrow::coupling {

namespace {

/// value - value is 0 for every finite number and NaN for the others: one sum tells of all of them,
/// and it vectorises.
bool all_finite(const double* values, int count) {
  const Eigen::Map<const VectorX> all(values, count);
  return (all - all).sum() == 0.0;
}

[[noreturn]] void refuse(const LAMMPS_NS::LAMMPS& lammps) {
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  int i = 0;
  while (all_finite(atom.x[i], 3) && all_finite(atom.v[i], 3)) ++i;
  const double *x = atom.x[i], *v = atom.v[i];
  throw StateError(fmt::format(
      "grain {} is at {:.6g} {:.6g} {:.6g} m with velocity {:.6g} {:.6g} {:.6g} m/s at step {}; "
      "grains overlap at the start, the time step is too large, or a command set a value that is "
      "no number",
      atom.tag[i], x[0], x[1], x[2], v[0], v[1], v[2], lammps.update->ntimestep));
}

}  // namespace

void check_grains_finite(const LAMMPS_NS::LAMMPS& lammps) {
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  if (atom.nlocal == 0 ||
      (all_finite(atom.x[0], 3 * atom.nlocal) && all_finite(atom.v[0], 3 * atom.nlocal)))
    return;
  refuse(lammps);
}

void check_velocities_finite(const LAMMPS_NS::LAMMPS& lammps) {
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  if (atom.nlocal > 0 && !all_finite(atom.v[0], 3 * atom.nlocal)) refuse(lammps);
}

bool moves_grains(const LAMMPS_NS::Fix& fix) {
  return fix.time_integrate != 0 || std::string(fix.style).rfind("multisphere", 0) == 0;
}

bool freezes_grains(const LAMMPS_NS::Fix& fix) { return fix.style == std::string("freeze"); }

}  // namespace furrow::coupling
