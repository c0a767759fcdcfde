// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/base/loads/snow_pairs.h"

// in this order: the first headers lack includes of their own
#include "pair.h"
#include "neigh_list.h"
#include "contact_models.h"
#include "pair_gran_proxy.h"

#include "force.h"

namespace furrow::coupling {

bool grains_are_snow(const LAMMPS_NS::LAMMPS& lammps) {
  auto* pair = dynamic_cast<LAMMPS_NS::PairGranProxy*>(lammps.force->pair);
  return pair && pair->hashcode() == LIGGGHTS::ContactModels::GranStyle<snow_bond_id>::HASHCODE;
}

}  // namespace furrow::coupling
