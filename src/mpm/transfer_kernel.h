// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The transfers of transfer.h for one instruction set.

#include "mpm/transfer/grid_to_particles.h"
#include "mpm/transfer/particles_to_grid.h"

namespace furrow {
inline namespace FURROW_ISA {

constexpr TransferKernels all_transfers(const char* instruction_set) {
  TransferKernels table{};
  table.instruction_set = instruction_set;
  table.find_weights = find_weights;
  table.scatter_momentum = scatter_momentum;
  table.scatter_force = scatter_force;
  table.scatter_point_forces = scatter_point_forces;
  table.gather_strain = gather_strain;
  table.stress_work = stress_work;
  table.gather_motion = gather_motion;
  table.interpolate_motion = interpolate_motion;
  return table;
}

}  // namespace FURROW_ISA
}  // namespace furrow
