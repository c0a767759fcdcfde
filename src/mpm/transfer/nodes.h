// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Interpolation from the 27 nodes of a particle: the four numbers of a node as one vector for a
/// single particle, one number in a lane for each of several particles of a cell.

#include "furrow/mpm/transfer/transfer.h"
#include "furrow/simd/lanes.h"

namespace furrow {
inline namespace FURROW_ISA {

// Vector of the four numbers of a node.
typedef double Vector4 __attribute__((vector_size(32)));
// Vector of four numbers anywhere in memory.
typedef double Stored4 __attribute__((vector_size(32), aligned(8), may_alias));

/// Distance in memory, in doubles, from a node to the next along x and y.
struct Strides {
  explicit Strides(const GridView& grid)
      : y(4 * (static_cast<std::size_t>(grid.axis[2].cells) + 2)),
        x(y * static_cast<std::size_t>(grid.columns_along_y)) {}
  std::size_t y, x;
};

/// The end of the run of particles of one cell that begins at p.
[[gnu::always_inline]] inline std::size_t end_of_cell(const Weights& weights, std::size_t p,
                                                      std::size_t count) {
  const int first_node = weights.first_node[p];
  do ++p;
  while (p < count && weights.first_node[p] == first_node);
  return p;
}

/// sum N_i q_i of a quantity q of the nodes.
[[gnu::always_inline]] inline void interpolate(const double* nodes, const Strides& stride,
                                               const Weights& weights, std::size_t p,
                                               Vector4& value) {
  const double* corner = nodes + 4 * static_cast<std::size_t>(weights.first_node[p]);
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

/// sum N_i q_i, and sum slope_d q_i along each axis d.
[[gnu::always_inline]] inline void interpolate_with_slopes(const double* nodes,
                                                           const Strides& stride,
                                                           const Weights& weights, std::size_t p,
                                                           Vector4& value, Vector4* slope) {
  const double* corner = nodes + 4 * static_cast<std::size_t>(weights.first_node[p]);
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

/// sum slope_d q_i along each axis d, for lane_count particles of one cell from p on. A component
/// of the nodes at a time.
[[gnu::always_inline]] inline void interpolate_slopes(const double* component,
                                                      const Strides& stride, const Weights& weights,
                                                      std::size_t p, Lanes* slope) {
  const auto lanes = [p](const double* values) __attribute__((always_inline)) {
    return Lanes::load(values + p);
  };
  Lanes w[stencil], g[stencil];
#pragma GCC unroll 3
  for (std::size_t j = 0; j < stencil; ++j) {
    w[j] = lanes(weights.value[1][j]);
    g[j] = lanes(weights.slope[1][j]);
  }
  Lanes total[stencil], along_x[stencil], along_y[stencil];
#pragma GCC unroll 3
  for (std::size_t i = 0; i < stencil; ++i) {
    const Lanes wx = lanes(weights.value[0][i]), gx = lanes(weights.slope[0][i]);
#pragma GCC unroll 3
    for (std::size_t k = 0; k < stencil; ++k) {
      const double* node = component + i * stride.x + 4 * k;
      const Lanes q0 = node[0], q1 = node[stride.y], q2 = node[2 * stride.y];
      const Lanes sum = w[0] * q0 + w[1] * q1 + w[2] * q2;
      const Lanes sum_y = g[0] * q0 + g[1] * q1 + g[2] * q2;
      total[k] = i == 0 ? wx * sum : total[k] + wx * sum;
      along_x[k] = i == 0 ? gx * sum : along_x[k] + gx * sum;
      along_y[k] = i == 0 ? wx * sum_y : along_y[k] + wx * sum_y;
    }
  }
  slope[0] = slope[1] = slope[2] = 0.0;
#pragma GCC unroll 3
  for (std::size_t k = 0; k < stencil; ++k) {
    const Lanes wz = lanes(weights.value[2][k]);
    slope[0] += wz * along_x[k];
    slope[1] += wz * along_y[k];
    slope[2] += lanes(weights.slope[2][k]) * total[k];
  }
}

}  // namespace FURROW_ISA
}  // namespace furrow
