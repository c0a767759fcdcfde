// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/drive/tilted_gravity.h"

#include "atom.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/base/roles/ground.h"
#include "fix_gravity.h"
#include "lammps.h"

namespace furrow::coupling {

void tilt_gravity_of_terrain(LAMMPS_NS::LAMMPS& lammps, const Matrix3& tilt) {
  for (Terrain* terrain : fixes_of<Terrain>(*lammps.modify)) terrain->tilt_gravity(tilt);
}

void tilt_gravity_of_grains(LAMMPS_NS::LAMMPS& lammps, const Matrix3& tilt) {
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  for (auto* fix : fixes_of<LAMMPS_NS::FixGravity>(*lammps.modify)) {
    Vector3 gravity;
    fix->get_gravity(gravity.data());
    const Vector3 change = tilt * gravity - gravity;
    for (int i = 0; i < atom.nlocal; ++i) {
      if (!(atom.mask[i] & fix->groupbit)) continue;
      const double mass = atom.rmass ? atom.rmass[i] : atom.mass[atom.type[i]];
      for (int c = 0; c < 3; ++c) atom.f[i][c] += mass * change[c];
    }
  }
}

}  // namespace furrow::coupling
