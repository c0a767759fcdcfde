// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The contacts between grains one by one, as LIGGGHTS hands them to its compute pair/gran/local.

#include <functional>

#include "furrow/core/types.h"
#include "lammps.h"

namespace furrow::coupling {

struct PairContact {
  int i, j;        ///< indices of the grains; j may be a ghost
  Vector3 force;   ///< on i [N]; on j its opposite
  Vector3 torque;  ///< on i about its centre [N m]
};

/// Computes the forces of all contacts of this rank's grains once more, from positions, velocities
/// and histories as they are, and calls for each. Histories and forces of grains stay. A contact
/// across ranks is seen on both (newton off). Needs a pair style gran that was set up, and no
/// compute pair/gran/local in the script, of which LIGGGHTS allows one.
void for_each_pair_contact(LAMMPS_NS::LAMMPS& lammps,
                           const std::function<void(const PairContact&)>& action);

}  // namespace furrow::coupling
