// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/data/box_motion.h"

#include <algorithm>
#include <cmath>

#include "atom.h"
#include "atom_vec.h"
#include "domain.h"

namespace furrow::coupling {

BoxMotion::~BoxMotion() {
  lammps_.domain->deform_vremap = 0;
  lammps_.atom->avec->init();
}

void BoxMotion::announce(const std::array<double, 3>& rates) {
  LAMMPS_NS::Domain& domain = *lammps_.domain;
  domain.deform_flag = domain.deform_vremap = 1;
  domain.deform_groupbit = group_bit_;
  std::fill_n(domain.h_rate, 6, 0.0);
  for (std::size_t k = 0; k < 3; ++k) domain.h_rate[k] = -rates[k] * domain.prd[k];
  lammps_.atom->avec->init();
}

void BoxMotion::advance(const std::array<double, 3>& rates, double dt) {
  LAMMPS_NS::Domain& domain = *lammps_.domain;
  for (std::size_t k = 0; k < 3; ++k) {
    const double middle = 0.5 * (domain.boxlo[k] + domain.boxhi[k]);
    const double half = 0.5 * domain.prd[k] * std::exp(-rates[k] * dt);
    domain.boxlo[k] = middle - half;
    domain.boxhi[k] = middle + half;
    domain.h_rate[k] = -2.0 * rates[k] * half;
    domain.h_ratelo[k] = rates[k] * half;
  }
  domain.set_global_box();
  domain.set_local_box();
}

double box_velocity_z(const LAMMPS_NS::LAMMPS& lammps, double z) {
  const LAMMPS_NS::Domain& domain = *lammps.domain;
  const double middle = 0.5 * (domain.boxlo[2] + domain.boxhi[2]);
  return domain.h_rate[2] / domain.prd[2] * (z - middle);
}

}  // namespace furrow::coupling
