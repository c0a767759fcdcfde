// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The transfers of transfer.h for one instruction set. Weights are found for a batch of particles
/// at once, in loops the compiler vectorises over particles; the 27 nodes of a particle are then
/// visited with the four numbers of a node as one vector.

#include "mpm/transfer.h"

#ifndef FURROW_ISA
#error "headers of kernels are for kernel units, which name the instruction set"
#endif

namespace furrow {
inline namespace FURROW_ISA {

// the four numbers of a node
typedef double Vector4 __attribute__((vector_size(32)));
// the same anywhere in memory
typedef double Stored4 __attribute__((vector_size(32), aligned(8), may_alias));

enum class Slope {
  moment,   // N d, for momentum and motion
  gradient  // G of transfer.h, for force and strain
};

/// A particle whose cell is not in the run of even cells: by the axis's tables.
template <Slope kind>
int find_weights_by_table(const AxisView& axis, int a, double x, std::size_t p, Weights& weights) {
  int bin = static_cast<int>((x - axis.lower) * axis.bins_per_length);
  bin = bin > 0 ? bin : 0;
  bin = bin < axis.bins ? bin : axis.bins - 1;
  int c = axis.cell_of_bin[bin];
  if (x >= axis.knot[c + 1] && c + 1 < axis.cells) ++c;
  const double below = x - axis.knot[c], above = axis.knot[c + 1] - x;
  const double w0 = axis.left[c] * above * above, w2 = axis.right[c] * below * below;
  const double w[stencil] = {w0, 1.0 - w0 - w2, w2};
  for (std::size_t i = 0; i < stencil; ++i) weights.value[a][i][p] = w[i];
  if (kind == Slope::gradient && axis.uneven[c]) {
    const double g0 = -2.0 * axis.left[c] * above, g2 = 2.0 * axis.right[c] * below;
    weights.slope[a][0][p] = g0;
    weights.slope[a][1][p] = -g0 - g2;
    weights.slope[a][2][p] = g2;
    return c;
  }
  double moment[stencil], spread = 0.0;
  for (std::size_t i = 0; i < stencil; ++i) {
    const double d = axis.node[c + static_cast<int>(i)] - x;
    moment[i] = w[i] * d;
    spread += moment[i] * d;
  }
  const double inverse = 1.0 / spread;
  for (std::size_t i = 0; i < stencil; ++i)
    weights.slope[a][i][p] = kind == Slope::moment ? moment[i] : moment[i] * inverse;
  if (kind == Slope::moment) weights.inverse_spread[a][p] = inverse;
  return c;
}

inline std::size_t count_outside(const GridView& grid, const double* const* position,
                                 std::size_t count) {
  int outside = 0;
  for (std::size_t p = 0; p < count; ++p) {
    int inside = 1;
    for (int a = 0; a < 3; ++a)
      inside &= static_cast<int>(position[a][p] >= grid.axis[a].from) &
                static_cast<int>(position[a][p] <= grid.axis[a].to);
    outside += 1 - inside;
  }
  return static_cast<std::size_t>(outside);
}

template <Slope kind>
void find_batch(const GridView& grid, const double* const* position, std::size_t count,
                Weights& weights) {
  int cell[3][batch], apart[batch];
  for (int a = 0; a < 3; ++a) {
    const AxisView& axis = grid.axis[a];
    const double* x = position[a];
    // Cells of one length: the splines are those of unit cells, D = h^2/4. No table, so that the
    // compiler vectorises.
    const double h = axis.even_length, per_length = 1.0 / h,
                 inverse_spread = 4.0 * per_length * per_length,
                 scale = kind == Slope::moment ? h : h * inverse_spread;
    int any = 0;
    for (std::size_t p = 0; p < count; ++p) {
      const double from_start = (x[p] - axis.even_start) * per_length;
      const double at = from_start + axis.even_from;
      const int c = static_cast<int>(at);
      const double f = at - c, g = 1.0 - f;
      const double w0 = 0.5 * g * g, w2 = 0.5 * f * f, w1 = 1.0 - w0 - w2;
      weights.value[a][0][p] = w0;
      weights.value[a][1][p] = w1;
      weights.value[a][2][p] = w2;
      weights.slope[a][0][p] = w0 * (-0.5 - f) * scale;
      weights.slope[a][1][p] = w1 * (0.5 - f) * scale;
      weights.slope[a][2][p] = w2 * (1.5 - f) * scale;
      if (kind == Slope::moment) weights.inverse_spread[a][p] = inverse_spread;
      cell[a][p] = c;
      apart[p] = static_cast<int>(from_start < 0.0) | static_cast<int>(c >= axis.even_to);
      any |= apart[p];
    }
    if (any)
      for (std::size_t p = 0; p < count; ++p)
        if (apart[p]) cell[a][p] = find_weights_by_table<kind>(axis, a, x[p], p, weights);
  }
  const int ny = grid.axis[1].cells + 2, nz = grid.axis[2].cells + 2;
  for (std::size_t p = 0; p < count; ++p)
    weights.first[p] = (cell[0][p] * ny + cell[1][p]) * nz + cell[2][p];
}

/// Numbers from a node to the next along x and y.
struct Strides {
  explicit Strides(const GridView& grid)
      : y(4 * (static_cast<std::size_t>(grid.axis[2].cells) + 2)),
        x(y * (static_cast<std::size_t>(grid.axis[1].cells) + 2)) {}
  std::size_t y, x;
};

/// What the particles of one cell give to its 27 nodes, held in registers until the last of them.
struct CellSum {
  Vector4 node[stencil][stencil][stencil];

  /// Adds N_i base + sum_d (slope of N_i along d) flux_d.
  [[gnu::always_inline]] void add(const Weights& weights, std::size_t p, const Vector4& base,
                                  const Vector4* flux) {
    Vector4 value_z[stencil];
#pragma GCC unroll 3
    for (std::size_t k = 0; k < stencil; ++k)
      value_z[k] = weights.value[2][k][p] * base + weights.slope[2][k][p] * flux[2];
    add_rows(weights, p, value_z, flux);
  }

  /// The same without base.
  [[gnu::always_inline]] void add(const Weights& weights, std::size_t p, const Vector4* flux) {
    Vector4 value_z[stencil];
#pragma GCC unroll 3
    for (std::size_t k = 0; k < stencil; ++k) value_z[k] = weights.slope[2][k][p] * flux[2];
    add_rows(weights, p, value_z, flux);
  }

  [[gnu::always_inline]] void give_to(const GridView& grid, const Strides& stride,
                                      int first) const {
    double* corner = grid.sums + 4 * static_cast<std::size_t>(first);
#pragma GCC unroll 3
    for (std::size_t i = 0; i < stencil; ++i)
#pragma GCC unroll 3
      for (std::size_t j = 0; j < stencil; ++j) {
        Stored4* row = reinterpret_cast<Stored4*>(corner + i * stride.x + j * stride.y);
#pragma GCC unroll 3
        for (std::size_t k = 0; k < stencil; ++k) row[k] += node[i][j][k];
      }
  }

 private:
  [[gnu::always_inline]] void add_rows(const Weights& weights, std::size_t p,
                                       const Vector4* value_z, const Vector4* flux) {
    Vector4 along_x[stencil], along_y[stencil];
#pragma GCC unroll 3
    for (std::size_t k = 0; k < stencil; ++k) {
      const double w = weights.value[2][k][p];
      along_x[k] = w * flux[0];
      along_y[k] = w * flux[1];
    }
#pragma GCC unroll 3
    for (std::size_t i = 0; i < stencil; ++i) {
      const double w = weights.value[0][i][p], g = weights.slope[0][i][p];
#pragma GCC unroll 3
      for (std::size_t k = 0; k < stencil; ++k) {
        const Vector4 value = w * value_z[k] + g * along_x[k], y_part = w * along_y[k];
#pragma GCC unroll 3
        for (std::size_t j = 0; j < stencil; ++j) {
          node[i][j][k] += weights.value[1][j][p] * value;
          node[i][j][k] += weights.slope[1][j][p] * y_part;
        }
      }
    }
  }
};

inline ParticleView part(const ParticleView& all, std::size_t first, std::size_t count) {
  ParticleView some = all;
  some.size = count;
  for (const double*& x : some.reference) x += first;
  for (double*& x : some.position) x += first;
  some.velocity += 4 * first;
  some.affine += 12 * first;
  some.volume += first;
  some.volume_ratio += first;
  for (const double*& s : some.stress) s += first;
  return some;
}

/// Calls visit(particles, number of the first) for batches of the particles.
template <class Visit>
void for_batches(const ParticleView& particles, Visit&& visit) {
  for (std::size_t first = 0; first < particles.size; first += batch)
    visit(part(particles, first, particles.size - first < batch ? particles.size - first : batch),
          first);
}

/// Calls add(sum, particle) for the particles in turn, and gives the sum of those of one cell to
/// its nodes.
template <class Add>
[[gnu::always_inline]] inline void for_cells(const GridView& grid, const Weights& weights,
                                             std::size_t count, Add&& add) {
  const Strides stride(grid);
  for (std::size_t p = 0; p < count;) {
    const int first = weights.first[p];
    CellSum sum = {};
    do add(sum, p);
    while (++p < count && weights.first[p] == first);
    sum.give_to(grid, stride, first);
  }
}

inline std::size_t scatter_momentum(const GridView& grid, const ParticleView& all, double density) {
  std::size_t outside = 0;
  for_batches(all, [&](const ParticleView& particles, std::size_t) {
    if (const std::size_t count = count_outside(grid, particles.reference, particles.size)) {
      outside += count;
      return;
    }
    Weights weights;
    find_batch<Slope::moment>(grid, particles.reference, particles.size, weights);
    for_cells(
        grid, weights,
        particles.size, [&](CellSum & sum, std::size_t p) __attribute__((always_inline)) {
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

inline void find_weights(const GridView& grid, const ParticleView& all, Weights* weights) {
  for_batches(all, [&](const ParticleView& particles, std::size_t first) {
    find_batch<Slope::gradient>(grid, particles.reference, particles.size, weights[first / batch]);
  });
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
        particles.size, [&](CellSum & sum, std::size_t p) __attribute__((always_inline)) {
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
    const double* position[3] = {one.position, one.position + 1, one.position + 2};
    find_batch<Slope::moment>(grid, position, 1, weights);
    const Vector4 base = {one.force[0], one.force[1], one.force[2], 0.0};
    Vector4 slope[3];
    for (int d = 0; d < 3; ++d) slope[d] = base * (one.lever[d] * weights.inverse_spread[d][0]);
    CellSum sum = {};
    sum.add(weights, 0, base, slope);
    sum.give_to(grid, stride, weights.first[0]);
  }
}

/// sum N_i q_i of a quantity of the nodes.
[[gnu::always_inline]] inline void read_value(const double* nodes, const Strides& stride,
                                              const Weights& weights, std::size_t p,
                                              Vector4& value) {
  const double* corner = nodes + 4 * static_cast<std::size_t>(weights.first[p]);
  Vector4 total[stencil] = {};
#pragma GCC unroll 3
  for (std::size_t i = 0; i < stencil; ++i) {
    Vector4 sum[stencil] = {};
#pragma GCC unroll 3
    for (std::size_t j = 0; j < stencil; ++j) {
      const Stored4* row = reinterpret_cast<const Stored4*>(corner + i * stride.x + j * stride.y);
#pragma GCC unroll 3
      for (std::size_t k = 0; k < stencil; ++k) sum[k] += weights.value[1][j][p] * row[k];
    }
#pragma GCC unroll 3
    for (std::size_t k = 0; k < stencil; ++k) total[k] += weights.value[0][i][p] * sum[k];
  }
  value = weights.value[2][0][p] * total[0] + weights.value[2][1][p] * total[1] +
          weights.value[2][2][p] * total[2];
}

/// sum N_i q_i, and sum (slope of N_i along d) q_i.
[[gnu::always_inline]] inline void read_slopes(const double* nodes, const Strides& stride,
                                               const Weights& weights, std::size_t p,
                                               Vector4& value, Vector4* slope) {
  const double* corner = nodes + 4 * static_cast<std::size_t>(weights.first[p]);
  Vector4 total[stencil] = {}, along_x[stencil] = {}, along_y[stencil] = {};
#pragma GCC unroll 3
  for (std::size_t i = 0; i < stencil; ++i) {
    Vector4 sum[stencil] = {}, sum_y[stencil] = {};
#pragma GCC unroll 3
    for (std::size_t j = 0; j < stencil; ++j) {
      const double w = weights.value[1][j][p], g = weights.slope[1][j][p];
      const Stored4* row = reinterpret_cast<const Stored4*>(corner + i * stride.x + j * stride.y);
#pragma GCC unroll 3
      for (std::size_t k = 0; k < stencil; ++k) {
        const Vector4 q = row[k];
        sum[k] += w * q;
        sum_y[k] += g * q;
      }
    }
    const double w = weights.value[0][i][p], g = weights.slope[0][i][p];
#pragma GCC unroll 3
    for (std::size_t k = 0; k < stencil; ++k) {
      total[k] += w * sum[k];
      along_x[k] += g * sum[k];
      along_y[k] += w * sum_y[k];
    }
  }
  value = slope[0] = slope[1] = slope[2] = Vector4{};
#pragma GCC unroll 3
  for (std::size_t k = 0; k < stencil; ++k) {
    const double w = weights.value[2][k][p];
    value += w * total[k];
    slope[0] += w * along_x[k];
    slope[1] += w * along_y[k];
    slope[2] += weights.slope[2][k][p] * total[k];
  }
}

inline void gather_strain(const GridView& grid, const ParticleView& all, const Weights* of_batches,
                          double dt, double* const* gradient) {
  const Strides stride(grid);
  for_batches(all, [&](const ParticleView& particles, std::size_t first) {
    const Weights& weights = of_batches[first / batch];
    for (std::size_t p = 0; p < particles.size; ++p) {
      Vector4 velocity, column[3];
      read_slopes(grid.velocity, stride, weights, p, velocity, column);
      for (int d = 0; d < 3; ++d) column[d] *= dt;
#pragma GCC unroll 3
      for (int row = 0; row < 3; ++row)
#pragma GCC unroll 3
        for (int d = 0; d < 3; ++d) gradient[3 * row + d][first + p] = column[d][row];
    }
  });
}

inline double stress_work(const ParticleView& particles, const double* const* h) {
  const double* const* s = particles.stress;
  // sums side by side: the order of additions is part of the result
  constexpr std::size_t lanes = 8;
  double work[lanes] = {};
  const auto of = [&](std::size_t p) {
    return particles.volume[p] * particles.volume_ratio[p] *
           (s[0][p] * h[0][p] + s[1][p] * h[4][p] + s[2][p] * h[8][p] +
            s[3][p] * (h[1][p] + h[3][p]) + s[4][p] * (h[5][p] + h[7][p]) +
            s[5][p] * (h[2][p] + h[6][p]));
  };
  const std::size_t whole = particles.size - particles.size % lanes;
  for (std::size_t p = 0; p < whole; p += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) work[lane] += of(p + lane);
  for (std::size_t p = whole; p < particles.size; ++p) work[p - whole] += of(p);
  double sum = 0.0;
  for (const double w : work) sum += w;
  return sum;
}

/// Velocity and C of a particle; C's fourth numbers would be slopes of the nodes' mass and must not
/// come back to them: zero.
[[gnu::always_inline]] inline void read_motion(const GridView& grid, const Strides& stride,
                                               const Weights& weights, std::size_t p,
                                               Vector4& velocity, Vector4* affine) {
  read_slopes(grid.velocity, stride, weights, p, velocity, affine);
  for (int d = 0; d < 3; ++d) {
    const double inverse = weights.inverse_spread[d][p];
    affine[d] *= Vector4{inverse, inverse, inverse, 0.0};
  }
}

inline void gather_motion(const GridView& grid, const ParticleView& all) {
  const Strides stride(grid);
  for_batches(all, [&](const ParticleView& particles, std::size_t) {
    Weights weights;
    find_batch<Slope::moment>(grid, particles.reference, particles.size, weights);
    for (std::size_t p = 0; p < particles.size; ++p) {
      Vector4 velocity, affine[3];
      read_motion(grid, stride, weights, p, velocity, affine);
      *reinterpret_cast<Stored4*>(particles.velocity + 4 * p) = velocity;
      Stored4* stored = reinterpret_cast<Stored4*>(particles.affine + 12 * p);
      for (int d = 0; d < 3; ++d) stored[d] = affine[d];
      Vector4 moved;
      read_value(grid.displacement, stride, weights, p, moved);
      for (int a = 0; a < 3; ++a) particles.position[a][p] += moved[a];
    }
  });
}

inline void probe(const GridView& grid, PointMotion* points, std::size_t count) {
  const Strides stride(grid);
  Weights weights;
  for (std::size_t n = 0; n < count; ++n) {
    PointMotion& point = points[n];
    const double* position[3] = {point.position, point.position + 1, point.position + 2};
    find_batch<Slope::moment>(grid, position, 1, weights);
    Vector4 velocity, affine[3];
    read_motion(grid, stride, weights, 0, velocity, affine);
    *reinterpret_cast<Stored4*>(point.velocity) = velocity;
    for (int d = 0; d < 3; ++d) *reinterpret_cast<Stored4*>(point.affine + 4 * d) = affine[d];
    Vector4 displacement;
    read_value(grid.displacement, stride, weights, 0, displacement);
    *reinterpret_cast<Stored4*>(point.displacement) = displacement;
  }
}

constexpr void fill(TransferKernels& kernels) {
  kernels.scatter_momentum = scatter_momentum;
  kernels.scatter_point_forces = scatter_point_forces;
  kernels.find_weights = find_weights;
  kernels.scatter_force = scatter_force;
  kernels.gather_strain = gather_strain;
  kernels.stress_work = stress_work;
  kernels.gather_motion = gather_motion;
  kernels.probe = probe;
}

}  // namespace FURROW_ISA
}  // namespace furrow
