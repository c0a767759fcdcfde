// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/output/gather_grains.h"

#include "atom.h"
#include "furrow/core/communicator.h"
#include "domain.h"

namespace furrow::coupling {

Grains gather_grains(LAMMPS_NS::LAMMPS& lammps, double bed_level,
                     const std::optional<Matrix3X>& virial) {
  constexpr int width = 11;  // id, x, v, radius, virial
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  std::vector<double> mine;
  mine.reserve(static_cast<std::size_t>(atom.nlocal) * width);
  for (int i = 0; i < atom.nlocal; ++i) {
    const double *x = atom.x[i], *v = atom.v[i];
    mine.insert(mine.end(), {static_cast<double>(atom.tag[i]), x[0], x[1], x[2], v[0], v[1], v[2],
                             atom.radius[i]});
    for (int k = 0; k < 3; ++k) mine.push_back(virial ? (*virial)(k, i) : 0.0);
  }
  const std::vector<double> all = Communicator(&lammps.world).gather_to_first(mine);

  Grains grains;
  grains.resize(all.size() / width);
  if (virial) grains.virial.resize(3, static_cast<Eigen::Index>(grains.size()));
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const double* row = all.data() + i * width;
    const auto column = static_cast<Eigen::Index>(i);
    grains.id[i] = static_cast<std::int64_t>(row[0]);
    grains.x.col(column) = Vector3(row[1], row[2], row[3]);
    grains.v.col(column) = Vector3(row[4], row[5], row[6]);
    grains.radius[column] = row[7];
    if (virial) grains.virial.col(column) = Vector3(row[8], row[9], row[10]);
  }
  const LAMMPS_NS::Domain& domain = *lammps.domain;
  const int periodic[3] = {domain.xperiodic, domain.yperiodic, domain.zperiodic};
  for (int k = 0; k < 3; ++k) grains.period[k] = periodic[k] ? domain.prd[k] : 0.0;
  grains.bed_level = bed_level;
  return grains;
}

}  // namespace furrow::coupling
