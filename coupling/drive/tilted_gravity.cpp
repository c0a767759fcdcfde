// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/drive/tilted_gravity.h"

#include "atom.h"
#include "coupling/liggghts/fixes_of.h"
#include "coupling/base/fix_terrain.h"
#include "fix_gravity.h"
#include "lammps.h"

namespace furrow::coupling {

Vector3 tilted(const Vector3& gravity, double angle) {
  return Eigen::AngleAxisd(angle, Vector3::UnitY()) * gravity;
}

void tilt_gravity_of_terrain(LAMMPS_NS::LAMMPS& lammps, double angle) {
  for (auto* fix : fixes_of<FixTerrain>(*lammps.modify)) {
    ContinuumTerrain& terrain = fix->terrain();
    terrain.set_gravity(tilted(terrain.parameters().gravity, angle));
  }
}

void tilt_gravity_of_grains(LAMMPS_NS::LAMMPS& lammps, double angle) {
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  for (auto* fix : fixes_of<LAMMPS_NS::FixGravity>(*lammps.modify)) {
    Vector3 gravity;
    fix->get_gravity(gravity.data());
    const Vector3 change = tilted(gravity, angle) - gravity;
    for (int i = 0; i < atom.nlocal; ++i) {
      if (!(atom.mask[i] & fix->groupbit)) continue;
      const double mass = atom.rmass ? atom.rmass[i] : atom.mass[atom.type[i]];
      for (int c = 0; c < 3; ++c) atom.f[i][c] += mass * change[c];
    }
  }
}

}  // namespace furrow::coupling
