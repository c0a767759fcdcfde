// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Particles to grid: mass and momentum, the force of the stress, forces at points.

#include "mpm/transfer/cell_sum.h"
#include "mpm/transfer/weights.h"

namespace furrow {
inline namespace FURROW_ISA {

inline std::size_t scatter_momentum(const GridView& grid, const ParticleView& all, double density) {
  std::size_t outside = 0;
  for_batches(all, [&](const ParticleView& particles, std::size_t) {
    if (const std::size_t count = count_outside(grid, particles.shape_position, particles.size)) {
      outside += count;
      return;
    }
    Weights weights;
    find_batch_weights<Slope::moment>(grid, particles.shape_position, particles.size, weights);
    for_cells(
        grid, weights,
        particles.size, [&](auto& sum, std::size_t p) __attribute__((always_inline)) {
          const double mass = density * particles.volume[p];
          const Stored4* affine = reinterpret_cast<const Stored4*>(particles.affine + 12 * p);
          Vector4 base = *reinterpret_cast<const Stored4*>(particles.velocity + 4 * p);
          base[3] = 1.0;
          const Vector4 slope[3] = {mass * affine[0], mass * affine[1], mass * affine[2]};
          sum.add(weights, p, mass * base, slope);
        });
  });
  return outside;
}

inline void scatter_force(const GridView& grid, const ParticleView& all,
                          const Weights* of_batches) {
  for_batches(all, [&](const ParticleView& particles, std::size_t first) {
    const Weights& weights = of_batches[first / batch];
    alignas(64) double force[6][batch];  // -V sigma
    for (int s = 0; s < 6; ++s)
      for (std::size_t p = 0; p < particles.size; ++p)
        force[s][p] = -particles.volume[p] * particles.volume_ratio[p] * particles.stress[s][p];
    for_cells(
        grid, weights,
        particles.size, [&](auto& sum, std::size_t p) __attribute__((always_inline)) {
          const double xx = force[0][p], yy = force[1][p], zz = force[2][p], xy = force[3][p],
                       yz = force[4][p], xz = force[5][p];
          const Vector4 flux[3] = {{xx, xy, xz, 0.0}, {xy, yy, yz, 0.0}, {xz, yz, zz, 0.0}};
          sum.add(weights, p, flux);
        });
  });
}

inline void scatter_point_forces(const GridView& grid, const PointForce* forces,
                                 std::size_t count) {
  const Strides stride(grid);
  Weights weights;
  for (std::size_t n = 0; n < count; ++n) {
    const PointForce& one = forces[n];
    const double* position[3] = {one.shape_position, one.shape_position + 1,
                                 one.shape_position + 2};
    find_batch_weights<Slope::moment>(grid, position, 1, weights);
    const Vector4 base = {one.force[0], one.force[1], one.force[2], 0.0};
    Vector4 slope[3];
    for (int d = 0; d < 3; ++d) slope[d] = base * (one.arm[d] * weights.inverse_spread[d][0]);
    CellSum sum = {};
    sum.add(weights, 0, base, slope);
    sum.add_to(grid, stride, weights.first_node[0]);
  }
}

}  // namespace FURROW_ISA
}  // namespace furrow
