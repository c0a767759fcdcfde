// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The transfers of transfer.h for one instruction set.

#include "furrow/mpm/transfer/grid_to_particles.h"
#include "furrow/mpm/transfer/particles_to_grid.h"

namespace furrow {
inline namespace FURROW_ISA {

constexpr void fill(TransferKernels& kernels) {
  kernels.find_weights = find_weights;
  kernels.scatter_momentum = scatter_momentum;
  kernels.scatter_force = scatter_force;
  kernels.scatter_point_forces = scatter_point_forces;
  kernels.gather_strain = gather_strain;
  kernels.stress_work = stress_work;
  kernels.gather_residual = gather_residual;
  kernels.gather_motion = gather_motion;
  kernels.interpolate_motion = interpolate_motion;
}

}  // namespace FURROW_ISA
}  // namespace furrow
