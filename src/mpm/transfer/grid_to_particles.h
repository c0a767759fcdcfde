// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Grid to particles: strain and its work, motion, and the motion at single points.

#include "furrow/mpm/transfer/nodes.h"
#include "furrow/mpm/transfer/weights.h"

namespace furrow {
inline namespace FURROW_ISA {

/// H of one particle.
[[gnu::always_inline]] inline void gather_strain_of_one(const GridView& grid, const Strides& stride,
                                                        const Weights& weights, std::size_t p,
                                                        double dt, double* const* gradient,
                                                        std::size_t to) {
  Vector4 velocity, column[3];
  interpolate_with_slopes(grid.velocity, stride, weights, p, velocity, column);
  for (int d = 0; d < 3; ++d) column[d] *= dt;
#pragma GCC unroll 3
  for (int row = 0; row < 3; ++row)
#pragma GCC unroll 3
    for (int d = 0; d < 3; ++d) gradient[3 * row + d][to] = column[d][row];
}

/// H of lane_count particles of one cell.
[[gnu::always_inline]] inline void gather_strain_of_lanes(const GridView& grid,
                                                          const Strides& stride,
                                                          const Weights& weights, std::size_t p,
                                                          double dt, double* const* gradient,
                                                          std::size_t to) {
  const double* corner = grid.velocity + 4 * static_cast<std::size_t>(weights.first_node[p]);
  for (int row = 0; row < 3; ++row) {
    Lanes slope[3];
    interpolate_slopes(corner + row, stride, weights, p, slope);
#pragma GCC unroll 3
    for (int d = 0; d < 3; ++d) (slope[d] * Lanes(dt)).store(gradient[3 * row + d] + to);
  }
}

/// Asks memory for what the law and the next transfers need of the particles from p on: more arrays
/// than a processor foresees.
[[gnu::always_inline]] inline void prefetch(const ParticleView& particles, std::size_t p) {
  for (const double* x : particles.quadrature_position) __builtin_prefetch(x + p);
  for (const double* s : particles.stress) __builtin_prefetch(s + p, 1);
  __builtin_prefetch(particles.volume + p);
  __builtin_prefetch(particles.volume_ratio + p, 1);
}

/// The particles of a cell are taken lane_count at a time. If more than a few remain, they are
/// taken together with particles before them in the cell or after it: those before get the same H
/// again, those after have yet to get theirs.
inline void gather_strain(const GridView& grid, const ParticleView& all, const Weights* of_batches,
                          double dt, double* const* gradient) {
  constexpr std::size_t lanes = lane_count, few = lanes / 4;
  constexpr std::size_t ahead = 4 * batch, line = 8;  // particles; numbers in a line of the cache
  const Strides stride(grid);
  for_batches(all, [&](const ParticleView& particles, std::size_t first) {
    const Weights& weights = of_batches[first / batch];
    for (std::size_t p = 0; p < particles.size; p += line) prefetch(particles, p + ahead);
    for (std::size_t p = 0; p < particles.size;) {
      const std::size_t start = p, end = end_of_cell(weights, p, particles.size);
      for (; p + lanes <= end; p += lanes)
        gather_strain_of_lanes(grid, stride, weights, p, dt, gradient, first + p);
      const bool full = end - start >= lanes;
      if (end - p > few && (full || p + lanes <= particles.size)) {
        const std::size_t from = full ? end - lanes : p;
        gather_strain_of_lanes(grid, stride, weights, from, dt, gradient, first + from);
      } else {
        for (; p < end; ++p)
          gather_strain_of_one(grid, stride, weights, p, dt, gradient, first + p);
      }
      p = end;
    }
  });
}

inline StressWork stress_work(const ParticleView& particles, const double* const* h) {
  const double* const* s = particles.stress;
  // Sums side by side: the order of the additions is fixed, however the loop is vectorised.
  constexpr std::size_t lanes = 8;
  double vertical[lanes] = {}, rest[lanes] = {};
  const auto add = [&](std::size_t p, std::size_t lane) {
    const double volume = particles.volume[p] * particles.volume_ratio[p];
    vertical[lane] += volume * (s[2][p] * h[8][p]);
    rest[lane] += volume * (s[0][p] * h[0][p] + s[1][p] * h[4][p] + s[3][p] * (h[1][p] + h[3][p]) +
                            s[4][p] * (h[5][p] + h[7][p]) + s[5][p] * (h[2][p] + h[6][p]));
  };
  const std::size_t whole = particles.size - particles.size % lanes;
  for (std::size_t p = 0; p < whole; p += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) add(p + lane, lane);
  for (std::size_t p = whole; p < particles.size; ++p) add(p, p - whole);
  StressWork work;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    work.vertical += vertical[lane];
    work.total += vertical[lane] + rest[lane];
  }
  return work;
}

/// Velocity and C of a particle. The fourth numbers of C, which would be slopes of the nodes' mass,
/// are zero: the next transfer to the grid must not bring them back.
[[gnu::always_inline]] inline void interpolate_affine(const GridView& grid, const Strides& stride,
                                                      const Weights& weights, std::size_t p,
                                                      Vector4& velocity, Vector4* affine) {
  interpolate_with_slopes(grid.velocity, stride, weights, p, velocity, affine);
  for (int d = 0; d < 3; ++d) {
    const double inverse = weights.inverse_spread[d][p];
    affine[d] *= Vector4{inverse, inverse, inverse, 0.0};
  }
}

/// The spin w about each axis for which the affine velocity [w]x of a particle has a moment of
/// momentum over mass: w_a = M_a/(D_b + D_c).
[[gnu::always_inline]] inline Vector4 moment_to_spin(const Vector4& moment,
                                                     const Vector4& per_spread) {
  const auto along = [&](int a, int b, int c) __attribute__((always_inline)) {
    return moment[a] * per_spread[b] * per_spread[c] / (per_spread[b] + per_spread[c]);
  };
  return Vector4{along(0, 1, 2), along(1, 2, 0), along(2, 0, 1), 0.0};
}

[[gnu::always_inline]] inline Vector4 cross(const Vector4& a, const Vector4& b) {
  return Vector4{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0],
                 0.0};
}

inline void gather_residual(const GridView& grid, const ParticleView& all) {
  const Strides stride(grid);
  for_batches(all, [&](const ParticleView& particles, std::size_t) {
    Weights weights;
    find_batch_weights<Slope::moment>(grid, particles.quadrature_position, particles.size, weights);
    for (std::size_t p = 0; p < particles.size; ++p) {
      Vector4 velocity, affine[3];
      interpolate_affine(grid, stride, weights, p, velocity, affine);
      Stored4* residual = reinterpret_cast<Stored4*>(particles.residual + 8 * p);
      residual[0] = *reinterpret_cast<const Stored4*>(particles.velocity + 4 * p) - velocity;
      const Stored4* carried = reinterpret_cast<const Stored4*>(particles.affine + 12 * p);
      for (int d = 0; d < 3; ++d) affine[d] = carried[d] - affine[d];
      const Vector4 per_spread = {weights.inverse_spread[0][p], weights.inverse_spread[1][p],
                                  weights.inverse_spread[2][p], 1.0};
      for (int d = 0; d < 3; ++d) affine[d] /= per_spread[d];
      const Vector4 moment = {affine[1][2] - affine[2][1], affine[2][0] - affine[0][2],
                              affine[0][1] - affine[1][0], 0.0};
      residual[1] = moment_to_spin(moment, per_spread);
    }
  });
}

inline void gather_motion(const GridView& grid, const ParticleView& all, double share) {
  const Strides stride(grid);
  for_batches(all, [&](const ParticleView& particles, std::size_t) {
    Weights weights;
    find_batch_weights<Slope::moment>(grid, particles.quadrature_position, particles.size, weights);
    for (std::size_t p = 0; p < particles.size; ++p) {
      Vector4 velocity, affine[3];
      interpolate_affine(grid, stride, weights, p, velocity, affine);
      Vector4 displacement;
      interpolate(grid.displacement, stride, weights, p, displacement);
      for (int a = 0; a < 3; ++a) particles.position[a][p] += displacement[a];
      Stored4* residual = reinterpret_cast<Stored4*>(particles.residual + 8 * p);
      // the spin takes back the change of angular momentum by the motion of the particle with r
      const Vector4 per_spread = {weights.inverse_spread[0][p], weights.inverse_spread[1][p],
                                  weights.inverse_spread[2][p], 0.0};
      residual[1] -= moment_to_spin(cross(displacement, residual[0]), per_spread);
      const Vector4 w = share * residual[1];
      const Vector4 turn[3] = {
          {0.0, w[2], -w[1], 0.0}, {-w[2], 0.0, w[0], 0.0}, {w[1], -w[0], 0.0, 0.0}};
      *reinterpret_cast<Stored4*>(particles.velocity + 4 * p) = velocity + share * residual[0];
      Stored4* stored = reinterpret_cast<Stored4*>(particles.affine + 12 * p);
      for (int d = 0; d < 3; ++d) stored[d] = affine[d] + turn[d];
    }
  });
}

inline void interpolate_motion(const GridView& grid, PointMotion* points, std::size_t count) {
  const Strides stride(grid);
  Weights weights;
  for (std::size_t n = 0; n < count; ++n) {
    PointMotion& point = points[n];
    const double* position[3] = {point.quadrature_position, point.quadrature_position + 1,
                                 point.quadrature_position + 2};
    find_batch_weights<Slope::moment>(grid, position, 1, weights);
    Vector4 velocity, affine[3];
    interpolate_affine(grid, stride, weights, 0, velocity, affine);
    *reinterpret_cast<Stored4*>(point.velocity) = velocity;
    for (int d = 0; d < 3; ++d) *reinterpret_cast<Stored4*>(point.affine + 4 * d) = affine[d];
    Vector4 displacement;
    interpolate(grid.displacement, stride, weights, 0, displacement);
    *reinterpret_cast<Stored4*>(point.displacement) = displacement;
  }
}

}  // namespace FURROW_ISA
}  // namespace furrow
