// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/base/loads/grain_forces.h"

#include <algorithm>

#include "atom.h"
#include "coupling/liggghts/styles/script.h"
#include "fix_property_atom.h"
#include "modify.h"

namespace furrow::coupling {

namespace {

constexpr char storage_id[] = "furrow_grain_forces";

double** storage(LAMMPS_NS::LAMMPS& lammps) {
  return static_cast<LAMMPS_NS::FixPropertyAtom*>(lammps.modify->find_fix_id(storage_id))
      ->array_atom;
}

}  // namespace

void GrainForces::make_storage() {
  // restart yes, no communication to ghosts or back, six values that begin with 0
  add_fix(lammps_, {storage_id, "all", "property/atom", storage_id, "vector", "yes", "no", "no",
                    "0", "0", "0", "0", "0", "0"});
}

void GrainForces::store() {
  const LAMMPS_NS::Atom& atom = *lammps_.atom;
  double** stored = storage(lammps_);
  for (int i = 0; i < atom.nlocal; ++i) {
    std::copy_n(atom.f[i], 3, stored[i]);
    std::copy_n(atom.torque[i], 3, stored[i] + 3);
  }
}

void GrainForces::put_back() {
  const LAMMPS_NS::Atom& atom = *lammps_.atom;
  double** stored = storage(lammps_);
  for (int i = 0; i < atom.nlocal; ++i) {
    std::copy_n(stored[i], 3, atom.f[i]);
    std::copy_n(stored[i] + 3, 3, atom.torque[i]);
  }
}

}  // namespace furrow::coupling
