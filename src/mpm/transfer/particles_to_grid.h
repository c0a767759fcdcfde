// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Particles to grid: mass and momentum, the force of the stress, forces at points.

#include "furrow/mpm/transfer/cell_sum.h"
#include "furrow/mpm/transfer/weights.h"

namespace furrow {
inline namespace FURROW_ISA {

inline std::size_t scatter_momentum(const GridView& grid, const ParticleView& all, double density) {
  std::size_t outside = 0;
  for_batches(all, [&](const ParticleView& particles, std::size_t) {
    if (const std::size_t count =
            count_outside(grid, particles.quadrature_position, particles.size)) {
      outside += count;
      return;
    }
    Weights weights;
    find_batch_weights<Slope::moment>(grid, particles.quadrature_position, particles.size, weights);
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

/// -V sigma of the particles of a batch [N m].
struct BatchStress {
  alignas(64) double force[6][batch];

  explicit BatchStress(const ParticleView& particles) {
    for (int s = 0; s < 6; ++s)
      for (std::size_t p = 0; p < particles.size; ++p)
        force[s][p] = -particles.volume[p] * particles.volume_ratio[p] * particles.stress[s][p];
    transpose(particles.size);
  }

#ifdef __AVX512F__
  alignas(64) double row[3][batch][4];  // of the stress; fourth numbers are zero

  void transpose(std::size_t count) {
    const auto load = [&](int s, std::size_t p) __attribute__((always_inline)) {
      return Vector8(*reinterpret_cast<const Stored8*>(force[s] + p));
    };
    for (std::size_t p = 0; p < count; p += 8) {
      const Vector8 xy = load(3, p), yz = load(4, p), xz = load(5, p);
      interleave(load(0, p), xy, xz, row[0][p]);
      interleave(xy, load(1, p), yz, row[1][p]);
      interleave(xz, yz, load(2, p), row[2][p]);
    }
  }
  [[gnu::always_inline]] void flux(std::size_t p, Vector8* rows) const {
    for (int r = 0; r < 3; ++r) rows[r] = PairedCellSum::carry(row[r][p]);
  }
#else
  static void transpose(std::size_t) {}  // the baseline assembles rows where they are used
  [[gnu::always_inline]] void flux(std::size_t p, Vector4* rows) const {
    const double xx = force[0][p], yy = force[1][p], zz = force[2][p], xy = force[3][p],
                 yz = force[4][p], xz = force[5][p];
    rows[0] = Vector4{xx, xy, xz, 0.0};
    rows[1] = Vector4{xy, yy, yz, 0.0};
    rows[2] = Vector4{xz, yz, zz, 0.0};
  }
#endif
};

inline void scatter_force(const GridView& grid, const ParticleView& all,
                          const Weights* of_batches) {
  for_batches(all, [&](const ParticleView& particles, std::size_t first) {
    const Weights& weights = of_batches[first / batch];
    const BatchStress stress(particles);
    for_cells(
        grid, weights,
        particles.size, [&](auto& sum, std::size_t p) __attribute__((always_inline)) {
          PairedCellSum::Carried flux[3];
          stress.flux(p, flux);
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
    const double* position[3] = {one.quadrature_position, one.quadrature_position + 1,
                                 one.quadrature_position + 2};
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
