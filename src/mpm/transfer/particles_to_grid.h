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
          using Sum = PairedCellSum;
          const double mass = density * particles.volume[p];
          Vector4 base = *reinterpret_cast<const Stored4*>(particles.velocity + 4 * p);
          base[3] = 1.0;
          const double* affine = particles.affine + 12 * p;
          const Sum::Carried slope[3] = {mass * Sum::carry(affine), mass * Sum::carry(affine + 4),
                                         mass * Sum::carry(affine + 8)};
          sum.add(weights, p, mass * Sum::carry(reinterpret_cast<const double*>(&base)), slope);
        });
  });
  return outside;
}

/// -V sigma of the particles of a batch, row by row of the stress; fourth numbers are zero [N m].
struct StressRows {
  alignas(64) double row[3][batch][4];
};

#ifdef __AVX512F__

/// Of eight particles from p on.
[[gnu::always_inline]] inline void find_eight_rows(const ParticleView& particles, std::size_t p,
                                                   StressRows& rows) {
  const auto load = [p](const double* values) __attribute__((always_inline)) {
    return Vector8(*reinterpret_cast<const Stored8*>(values + p));
  };
  const Vector8 volume = -load(particles.volume) * load(particles.volume_ratio);
  Vector8 s[6];
  for (int k = 0; k < 6; ++k) s[k] = volume * load(particles.stress[k]);
  interleave(s[0], s[3], s[5], rows.row[0][p]);
  interleave(s[3], s[1], s[4], rows.row[1][p]);
  interleave(s[5], s[4], s[2], rows.row[2][p]);
}

#endif

inline void find_stress_rows(const ParticleView& particles, StressRows& rows) {
  std::size_t p = 0;
#ifdef __AVX512F__
  for (; p + 8 <= particles.size; p += 8) find_eight_rows(particles, p, rows);
#endif
  constexpr int component[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
  for (; p < particles.size; ++p) {
    const double volume = -particles.volume[p] * particles.volume_ratio[p];
    for (int r = 0; r < 3; ++r) {
      const int* c = component[r];
      const Vector4 row = {particles.stress[c[0]][p], particles.stress[c[1]][p],
                           particles.stress[c[2]][p], 0.0};
      *reinterpret_cast<Stored4*>(rows.row[r][p]) = volume * row;
    }
  }
}

inline void scatter_force(const GridView& grid, const ParticleView& all,
                          const Weights* of_batches) {
  for_batches(all, [&](const ParticleView& particles, std::size_t first) {
    const Weights& weights = of_batches[first / batch];
    StressRows rows;
    find_stress_rows(particles, rows);
    for_cells(
        grid, weights,
        particles.size, [&](auto& sum, std::size_t p) __attribute__((always_inline)) {
          using Sum = PairedCellSum;
          const Sum::Carried flux[3] = {Sum::carry(rows.row[0][p]), Sum::carry(rows.row[1][p]),
                                        Sum::carry(rows.row[2][p])};
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
