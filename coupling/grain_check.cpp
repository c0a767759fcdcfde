#include "coupling/grain_check.h"

#include <cmath>

#include <fmt/format.h>

#include "atom.h"
#include "core/error.h"
#include "update.h"

namespace furrow::coupling {

namespace {

/// value - value is 0 for every finite number and NaN for the others: one sum tells of all of them, and it vectorises.
bool all_finite(const double* values, int count) {
  double sum = 0.0;
  for (int i = 0; i < count; ++i) sum += values[i] - values[i];
  return sum == 0.0;
}

}  // namespace

void check_grains_finite(const LAMMPS_NS::LAMMPS& lammps) {
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  if (atom.nlocal == 0 || (all_finite(atom.x[0], 3 * atom.nlocal) && all_finite(atom.v[0], 3 * atom.nlocal))) return;
  for (int i = 0; i < atom.nlocal; ++i) {
    const double *x = atom.x[i], *v = atom.v[i];
    if (all_finite(x, 3) && all_finite(v, 3)) continue;
    throw StateError(fmt::format("grain {} is at {:.6g} {:.6g} {:.6g} m with velocity {:.6g} {:.6g} {:.6g} m/s at step {}; grains overlap "
                                 "at the start, the time step is too large, or a command set a value that is no number",
                                 atom.tag[i], x[0], x[1], x[2], v[0], v[1], v[2], lammps.update->ntimestep));
  }
}

}  // namespace furrow::coupling
