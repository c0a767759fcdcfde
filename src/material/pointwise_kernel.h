// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Kernel of pointwise laws: kinematics, rotation, energies and checks as for every law, with one
/// call of the law for each point between them.

#include "furrow/material/block_update.h"
#include "furrow/material/pointwise_parameters.h"

namespace furrow {
inline namespace FURROW_ISA {

using PointwisePoints = Points<max_pointwise_variables>;

/// Step of the law for one point, copied out of its lane and back.
inline void step_lane(const PointwiseParameters& parameters, const Group& group, int lane,
                      const Symmetric& strain, PointwisePoints& points) {
  const Lanes* const strains[6] = {&strain.xx, &strain.yy, &strain.zz,
                                   &strain.xy, &strain.yz, &strain.xz};
  Lanes* const stresses[6] = {&points.stress.xx, &points.stress.yy, &points.stress.zz,
                              &points.stress.xy, &points.stress.yz, &points.stress.xz};
  PointwiseNumbers numbers;
  for (int k = 0; k < 6; ++k) {
    numbers.strain[k] = (*strains[k])[lane];
    numbers.stress[k] = (*stresses[k])[lane];
  }
  for (int k = 0; k < parameters.internal_variables; ++k)
    numbers.internal[k] = points.internal[k][lane];
  numbers.stored = 0.0;
  numbers.frozen = 0.0;
  numbers.dissipated = 0.0;
  numbers.branch = 0.0;
  numbers.iterations = 0.0;
  numbers.below_data = false;
  numbers.beyond_data = false;
  parameters.step(parameters.context, group.first + static_cast<std::size_t>(lane), numbers);
  for (int k = 0; k < 6; ++k) (*stresses[k])[lane] = numbers.stress[k];
  for (int k = 0; k < parameters.internal_variables; ++k)
    points.internal[k][lane] = numbers.internal[k];
  points.stored[lane] = numbers.stored;
  points.frozen[lane] = numbers.frozen;
  points.dissipated[lane] = numbers.dissipated;
  points.branch[lane] = numbers.branch;
  points.iterations[lane] = numbers.iterations;
  points.below_data[lane] = numbers.below_data;
  points.beyond_data[lane] = numbers.beyond_data;
}

inline BlockResult update_pointwise(const PointwiseParameters& parameters, double density,
                                    const PointBlock& block) {
  const int used = parameters.internal_variables;
  BlockResult result;
  for (std::size_t first = 0; first < block.size; first += lane_count) {
    const Group group(block, first);
    PointwisePoints points = group.load_points<max_pointwise_variables>(used);
    Motion motion;
    find_motion(group.load_gradient(), motion);
    for (int lane = 0; lane < group.lanes; ++lane)
      if (motion.admissible[lane]) step_lane(parameters, group, lane, motion.strain, points);
    points.stress = rotated(points.stress, motion.rotation);
    for (int k = 0; k < parameters.tensor_count; ++k) {
      Lanes* const t = points.internal + parameters.tensors[k];
      const Symmetric tensor =
          rotated(Symmetric{t[0], t[1], t[2], t[3], t[4], t[5]}, motion.rotation);
      t[0] = tensor.xx;
      t[1] = tensor.yy;
      t[2] = tensor.zz;
      t[3] = tensor.xy;
      t[4] = tensor.yz;
      t[5] = tensor.xz;
    }
    if (!group.store_points(points, {motion.volume, motion.admissible, false}, density, result,
                            used))
      break;
  }
  return result;
}

constexpr void fill(PointwiseKernels& kernels) { kernels.update = update_pointwise; }

}  // namespace FURROW_ISA
}  // namespace furrow
