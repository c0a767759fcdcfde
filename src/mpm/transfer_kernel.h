#pragma once
/// The transfers of transfer.h for one instruction set. Weights are found for a batch of particles at once, in loops the compiler
/// vectorises over particles; the 27 nodes of a particle are then visited with the four numbers of a node as one vector.

#include "mpm/transfer.h"

#ifndef FURROW_ISA
#error "kernel headers are for transfer_*.cpp, which name the instruction set"
#endif

namespace furrow {
inline namespace FURROW_ISA {

typedef double Vector4 __attribute__((vector_size(32)));                         // momentum and mass, or velocity, of a node
typedef double Stored4 __attribute__((vector_size(32), aligned(8), may_alias));  // the same anywhere in memory

constexpr std::size_t batch = 64;  // particles: their weights fit the first cache

/// B-splines of a batch: values, values times d_i, D and 1/D, direction by direction.
struct Weights {
  double value[3][stencil][batch];
  double moment[3][stencil][batch];
  double gradient[3][stencil][batch];  // set for uneven particles only: N d/D of even cells, N' of uneven ones
  double spread[3][batch], inverse_spread[3][batch];
  double flux_factor[3][batch];  // 1/D; 1 for uneven particles, whose force goes by gradients
  int first[batch];              // node of the lowest corner
  int uneven[batch];             // 1: in an uneven cell of any axis
};

/// A particle whose cell is not in the run of even cells: by the axis's tables.
inline int find_weights_by_table(const AxisView& axis, int a, double x, std::size_t p, Weights& weights) {
  int bin = static_cast<int>((x - axis.lower) * axis.bins_per_length);
  bin = bin > 0 ? bin : 0;
  bin = bin < axis.bins ? bin : axis.bins - 1;
  int c = axis.cell_of_bin[bin];
  if (x >= axis.knot[c + 1] && c + 1 < axis.cells) ++c;
  const double below = x - axis.knot[c], above = axis.knot[c + 1] - x;
  const double w0 = axis.left[c] * above * above, w2 = axis.right[c] * below * below;
  const double w[stencil] = {w0, 1.0 - w0 - w2, w2};
  double spread = 0.0;
  for (std::size_t i = 0; i < stencil; ++i) {
    const double d = axis.node[c + static_cast<int>(i)] - x;
    weights.value[a][i][p] = w[i];
    weights.moment[a][i][p] = w[i] * d;
    spread += w[i] * d * d;
  }
  weights.spread[a][p] = spread;
  weights.inverse_spread[a][p] = weights.flux_factor[a][p] = 1.0 / spread;
  weights.uneven[p] |= axis.uneven[c];
  return c;
}

/// Gradients of an uneven particle's splines.
inline void find_gradients(const GridView& grid, const double* const* position, const int (&cell)[3][batch], std::size_t p,
                           Weights& weights) {
  for (int a = 0; a < 3; ++a) {
    const AxisView& axis = grid.axis[a];
    const int c = cell[a][p];
    const double x = position[a][p], inverse = weights.inverse_spread[a][p];
    const double g0 = -2.0 * axis.left[c] * (axis.knot[c + 1] - x), g2 = 2.0 * axis.right[c] * (x - axis.knot[c]);
    const double own[stencil] = {g0, -g0 - g2, g2};
    for (std::size_t i = 0; i < stencil; ++i)
      weights.gradient[a][i][p] = axis.uneven[c] ? own[i] : weights.moment[a][i][p] * inverse;
    weights.flux_factor[a][p] = 1.0;
  }
}

/// @return how many of the particles are outside
inline std::size_t find_weights(const GridView& grid, const double* const* position, std::size_t count, Weights& weights) {
  int cell[3][batch], apart[batch];
  for (std::size_t p = 0; p < count; ++p) weights.uneven[p] = 0;
  for (int a = 0; a < 3; ++a) {
    const AxisView& axis = grid.axis[a];
    const double* x = position[a];
    int inside = 0;
    for (std::size_t p = 0; p < count; ++p)
      inside += static_cast<int>(x[p] >= axis.from) & static_cast<int>(x[p] <= axis.to);
    if (static_cast<std::size_t>(inside) < count) return count - static_cast<std::size_t>(inside);
    // Cells of one length: the splines are those of unit cells, D = h^2/4. No table, so that the compiler vectorises.
    const double h = axis.even_length, per_length = 1.0 / h, spread = 0.25 * h * h;
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
      weights.moment[a][0][p] = w0 * (-0.5 - f) * h;
      weights.moment[a][1][p] = w1 * (0.5 - f) * h;
      weights.moment[a][2][p] = w2 * (1.5 - f) * h;
      weights.spread[a][p] = spread;
      weights.inverse_spread[a][p] = weights.flux_factor[a][p] = 1.0 / spread;
      cell[a][p] = c;
      apart[p] = static_cast<int>(from_start < 0.0) | static_cast<int>(c >= axis.even_to);
      any |= apart[p];
    }
    if (any)
      for (std::size_t p = 0; p < count; ++p)
        if (apart[p]) cell[a][p] = find_weights_by_table(axis, a, x[p], p, weights);
  }
  for (std::size_t p = 0; p < count; ++p)
    if (weights.uneven[p]) find_gradients(grid, position, cell, p, weights);
  const int ny = grid.axis[1].cells + 2, nz = grid.axis[2].cells + 2;
  for (std::size_t p = 0; p < count; ++p) weights.first[p] = (cell[0][p] * ny + cell[1][p]) * nz + cell[2][p];
  return 0;
}

/// What the particles of one cell give to its 27 nodes, held in registers until the last of them.
struct CellSum {
  Vector4 node[stencil][stencil][stencil];

  /// Adds N_i (base + sum_d slope_d d_i,d).
  [[gnu::always_inline]] void add(const Weights& weights, std::size_t p, const Vector4& base, const Vector4* slope) {
    Vector4 value_z[stencil], along_x[stencil], along_y[stencil];
#pragma GCC unroll 3
    for (std::size_t k = 0; k < stencil; ++k) {
      const double w = weights.value[2][k][p];
      value_z[k] = w * base + weights.moment[2][k][p] * slope[2];
      along_x[k] = w * slope[0];
      along_y[k] = w * slope[1];
    }
#pragma GCC unroll 3
    for (std::size_t i = 0; i < stencil; ++i) {
      const double w = weights.value[0][i][p], m = weights.moment[0][i][p];
#pragma GCC unroll 3
      for (std::size_t k = 0; k < stencil; ++k) {
        const Vector4 value = w * value_z[k] + m * along_x[k], y_part = w * along_y[k];
#pragma GCC unroll 3
        for (std::size_t j = 0; j < stencil; ++j) {
          node[i][j][k] += weights.value[1][j][p] * value;
          node[i][j][k] += weights.moment[1][j][p] * y_part;
        }
      }
    }
  }

  [[gnu::always_inline]] void give_to(const GridView& grid, int first) const {
    const std::size_t nz = static_cast<std::size_t>(grid.axis[2].cells) + 2,
                      plane = (static_cast<std::size_t>(grid.axis[1].cells) + 2) * nz;
    double* corner = grid.node + 4 * static_cast<std::size_t>(first);
#pragma GCC unroll 3
    for (std::size_t i = 0; i < stencil; ++i)
#pragma GCC unroll 3
      for (std::size_t j = 0; j < stencil; ++j) {
        Stored4* row = reinterpret_cast<Stored4*>(corner + 4 * (i * plane + j * nz));
#pragma GCC unroll 3
        for (std::size_t k = 0; k < stencil; ++k) row[k] += node[i][j][k];
      }
  }
};

/// Adds the force of the stress of an uneven particle: sum_d flux_d dN_i/dx_d.
inline void add_flux_to_nodes(const GridView& grid, const Weights& weights, std::size_t p, const Vector4* flux) {
  const std::size_t nz = static_cast<std::size_t>(grid.axis[2].cells) + 2,
                    plane = (static_cast<std::size_t>(grid.axis[1].cells) + 2) * nz;
  double* corner = grid.node + 4 * static_cast<std::size_t>(weights.first[p]);
  for (std::size_t i = 0; i < stencil; ++i) {
    const double wx = weights.value[0][i][p], gx = weights.gradient[0][i][p];
    for (std::size_t j = 0; j < stencil; ++j) {
      const double wy = weights.value[1][j][p], gy = weights.gradient[1][j][p];
      const Vector4 across = (gx * wy) * flux[0] + (wx * gy) * flux[1], along = (wx * wy) * flux[2];
      Stored4* row = reinterpret_cast<Stored4*>(corner + 4 * (i * plane + j * nz));
      for (std::size_t k = 0; k < stencil; ++k)
        row[k] += weights.value[2][k][p] * across + weights.gradient[2][k][p] * along;
    }
  }
}

/// The velocity gradient of an uneven particle, column by column.
inline void read_gradient(const GridView& grid, const Weights& weights, std::size_t p, Vector4* rate) {
  const std::size_t nz = static_cast<std::size_t>(grid.axis[2].cells) + 2,
                    plane = (static_cast<std::size_t>(grid.axis[1].cells) + 2) * nz;
  const double* corner = grid.node + 4 * static_cast<std::size_t>(weights.first[p]);
  for (int d = 0; d < 3; ++d) rate[d] = Vector4{};
  for (std::size_t i = 0; i < stencil; ++i) {
    const double wx = weights.value[0][i][p], gx = weights.gradient[0][i][p];
    for (std::size_t j = 0; j < stencil; ++j) {
      const double wy = weights.value[1][j][p], gy = weights.gradient[1][j][p];
      const Stored4* row = reinterpret_cast<const Stored4*>(corner + 4 * (i * plane + j * nz));
      Vector4 sum = {}, sum_z = {};
      for (std::size_t k = 0; k < stencil; ++k) {
        const Vector4 v = row[k];
        sum += weights.value[2][k][p] * v;
        sum_z += weights.gradient[2][k][p] * v;
      }
      rate[0] += (gx * wy) * sum;
      rate[1] += (wx * gy) * sum;
      rate[2] += (wx * wy) * sum_z;
    }
  }
}

inline ParticleView part(const ParticleView& all, std::size_t first, std::size_t count) {
  ParticleView some = all;
  some.size = count;
  for (double*& x : some.position) x += first;
  some.velocity += 4 * first;
  some.affine += 12 * first;
  some.volume += first;
  some.volume_ratio += first;
  for (const double*& s : some.stress) s += first;
  return some;
}

inline std::size_t scatter_batch(const GridView& grid, const ParticleView& particles, double density, double dt,
                                 const double* gravity) {
  Weights weights;
  if (const std::size_t outside = find_weights(grid, particles.position, particles.size, weights)) return outside;
  // -dt V sigma D^-1, column by column; without D^-1 for uneven particles
  alignas(64) double force[9][batch];
  constexpr int entry[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};  // of the stress: row, column
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) {
      const double *stress = particles.stress[entry[row][column]], *factor = weights.flux_factor[column];
      for (std::size_t p = 0; p < particles.size; ++p)
        force[3 * column + row][p] = -dt * particles.volume[p] * particles.volume_ratio[p] * stress[p] * factor[p];
    }
  const Vector4 fall = {dt * gravity[0], dt * gravity[1], dt * gravity[2], 0.0};
  for (std::size_t p = 0; p < particles.size;) {
    const int first = weights.first[p];
    CellSum sum = {};
    do {
      const double mass = density * particles.volume[p];
      const Stored4* affine = reinterpret_cast<const Stored4*>(particles.affine + 12 * p);
      Vector4 base = *reinterpret_cast<const Stored4*>(particles.velocity + 4 * p) + fall;
      base[3] = 1.0;
      base *= mass;
      Vector4 slope[3], flux[3];
      for (int d = 0; d < 3; ++d) {
        slope[d] = mass * affine[d];
        flux[d] = Vector4{force[3 * d][p], force[3 * d + 1][p], force[3 * d + 2][p], 0.0};
      }
      if (weights.uneven[p])
        add_flux_to_nodes(grid, weights, p, flux);
      else
        for (int d = 0; d < 3; ++d) slope[d] += flux[d];
      sum.add(weights, p, base, slope);
      ++p;
    } while (p < particles.size && weights.first[p] == first);
    sum.give_to(grid, first);
  }
  return 0;
}

inline std::size_t scatter(const GridView& grid, const ParticleView& particles, double density, double dt,
                           const double* gravity) {
  std::size_t outside = 0;
  for (std::size_t first = 0; first < particles.size; first += batch) {
    const std::size_t count = particles.size - first < batch ? particles.size - first : batch;
    outside += scatter_batch(grid, part(particles, first, count), density, dt, gravity);
  }
  return outside;
}

inline void scatter_impulses(const GridView& grid, const PointImpulse* impulses, std::size_t count) {
  Weights weights;
  for (std::size_t n = 0; n < count; ++n) {
    const PointImpulse& one = impulses[n];
    const double* position[3] = {one.position, one.position + 1, one.position + 2};
    if (find_weights(grid, position, 1, weights) > 0) continue;
    const Vector4 base = {one.impulse[0], one.impulse[1], one.impulse[2], 0.0};
    Vector4 slope[3];
    for (int d = 0; d < 3; ++d) slope[d] = base * (one.lever[d] * weights.inverse_spread[d][0]);
    CellSum sum = {};
    sum.add(weights, 0, base, slope);
    sum.give_to(grid, weights.first[0]);
  }
}

/// Velocity and its gradient from the nodes of particle p.
inline void read_nodes(const GridView& grid, const Weights& weights, std::size_t p, Vector4& velocity, Vector4* affine) {
  const std::size_t nz = static_cast<std::size_t>(grid.axis[2].cells) + 2,
                    plane = (static_cast<std::size_t>(grid.axis[1].cells) + 2) * nz;
  Vector4 value[stencil] = {}, along_x[stencil] = {}, along_y[stencil] = {};
  const double* corner = grid.node + 4 * static_cast<std::size_t>(weights.first[p]);
  for (std::size_t i = 0; i < stencil; ++i) {
    Vector4 sum[stencil] = {}, sum_y[stencil] = {};
    for (std::size_t j = 0; j < stencil; ++j) {
      const double wy = weights.value[1][j][p], my = weights.moment[1][j][p];
      const Stored4* row = reinterpret_cast<const Stored4*>(corner + 4 * (i * plane + j * nz));
      for (std::size_t k = 0; k < stencil; ++k) {
        const Vector4 v = row[k];
        sum[k] += wy * v;
        sum_y[k] += my * v;
      }
    }
    const double w = weights.value[0][i][p], m = weights.moment[0][i][p];
    for (std::size_t k = 0; k < stencil; ++k) {
      value[k] += w * sum[k];
      along_x[k] += m * sum[k];
      along_y[k] += w * sum_y[k];
    }
  }
  velocity = Vector4{};
  for (int d = 0; d < 3; ++d) affine[d] = Vector4{};
  for (std::size_t k = 0; k < stencil; ++k) {
    const double w = weights.value[2][k][p];
    velocity += w * value[k];
    affine[0] += w * along_x[k];
    affine[1] += w * along_y[k];
    affine[2] += weights.moment[2][k][p] * value[k];
  }
  for (int d = 0; d < 3; ++d) {  // the fourth number is the mass of nodes: it must not come back to them as a slope of mass
    const double inverse = weights.inverse_spread[d][p];
    affine[d] *= Vector4{inverse, inverse, inverse, 0.0};
  }
}

inline void gather_batch(const GridView& grid, const ParticleView& particles, double density, double dt,
                         double* const* gradient, std::size_t first, TransferSums& sums) {
  Weights weights;
  if (const std::size_t outside = find_weights(grid, particles.position, particles.size, weights)) {
    if (sums.outside == 0) sums.first_outside = first;
    sums.outside += outside;
    return;
  }
  Vector4 momentum = {}, energy = {}, largest = {}, rates[3][batch];
  for (std::size_t p = 0; p < particles.size; ++p) {
    Vector4 velocity, affine[3];
    read_nodes(grid, weights, p, velocity, affine);
    *reinterpret_cast<Stored4*>(particles.velocity + 4 * p) = velocity;
    Stored4* stored = reinterpret_cast<Stored4*>(particles.affine + 12 * p);
    for (int d = 0; d < 3; ++d) stored[d] = rates[d][p] = affine[d];
    if (weights.uneven[p]) {
      Vector4 rate[3];
      read_gradient(grid, weights, p, rate);
      for (int d = 0; d < 3; ++d) rates[d][p] = rate[d];
    }
    const double mass = density * particles.volume[p];
    const Vector4 square = velocity * velocity;
    momentum += mass * velocity;
    Vector4 own = square;
    for (int d = 0; d < 3; ++d) own += affine[d] * affine[d] * weights.spread[d][p];
    energy += (0.5 * mass) * own;
    largest = square > largest ? square : largest;
  }
  for (int a = 0; a < 3; ++a)
    for (std::size_t p = 0; p < particles.size; ++p) particles.position[a][p] += dt * particles.velocity[4 * p + a];
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      for (std::size_t p = 0; p < particles.size; ++p) gradient[3 * row + column][first + p] = dt * rates[column][p][row];
  const double* const* s = particles.stress;
  double work = 0.0;
  for (std::size_t p = 0; p < particles.size; ++p) {
    const std::size_t q = first + p;
    work += particles.volume[p] * particles.volume_ratio[p] *
            (s[0][p] * gradient[0][q] + s[1][p] * gradient[4][q] + s[2][p] * gradient[8][q] +
             s[3][p] * (gradient[1][q] + gradient[3][q]) + s[4][p] * (gradient[5][q] + gradient[7][q]) +
             s[5][p] * (gradient[2][q] + gradient[6][q]));
  }
  sums.stress_work += work;
  sums.kinetic_energy += energy[0] + energy[1] + energy[2];
  for (int a = 0; a < 3; ++a) sums.momentum[a] += momentum[a];
  const double fastest = largest[0] + largest[1] + largest[2];
  if (fastest > sums.largest_speed * sums.largest_speed) sums.largest_speed = __builtin_sqrt(fastest);
}

inline TransferSums gather(const GridView& grid, const ParticleView& particles, double density, double dt,
                           double* const* gradient) {
  TransferSums sums;
  for (std::size_t first = 0; first < particles.size; first += batch) {
    const std::size_t count = particles.size - first < batch ? particles.size - first : batch;
    gather_batch(grid, part(particles, first, count), density, dt, gradient, first, sums);
  }
  return sums;
}

constexpr TransferKernels all_transfers(const char* instruction_set) {
  return {instruction_set, scatter, scatter_impulses, gather};
}

}  // namespace FURROW_ISA
}  // namespace furrow
