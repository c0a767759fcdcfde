// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/output/grain_virial.h"

#include "atom.h"
#include "compute.h"
#include "coupling/liggghts/styles/script.h"
#include "modify.h"
#include "update.h"

namespace furrow::coupling {

namespace {

constexpr char compute_id[] = "furrow_grain_virial";

LAMMPS_NS::Compute& virial_compute(LAMMPS_NS::LAMMPS& lammps) {
  return *lammps.modify->compute[lammps.modify->find_compute(compute_id)];
}

}  // namespace

void add_grain_virial(LAMMPS_NS::LAMMPS& lammps) {
  add_compute(lammps, {compute_id, "all", "stress/atom", "pair"});
}

void ask_for_grain_virial(LAMMPS_NS::LAMMPS& lammps) {
  const LAMMPS_NS::Update& update = *lammps.update;
  if (update.laststep > update.ntimestep) virial_compute(lammps).addstep(update.laststep);
}

std::optional<Matrix3X> grain_virial(LAMMPS_NS::LAMMPS& lammps) {
  LAMMPS_NS::Compute& compute = virial_compute(lammps);
  const LAMMPS_NS::Update& update = *lammps.update;
  if (update.nsteps == 0 || !compute.matchstep(update.ntimestep)) return std::nullopt;
  compute.compute_peratom();
  Matrix3X virial(3, lammps.atom->nlocal);
  for (int i = 0; i < lammps.atom->nlocal; ++i)
    virial.col(i) = Eigen::Map<const Vector3>(compute.array_atom[i]);  // xx, yy, zz
  return virial;
}

}  // namespace furrow::coupling
