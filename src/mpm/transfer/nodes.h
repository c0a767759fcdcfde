// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Access to the 27 nodes of a particle, with the four numbers of a node as one vector: sums to the
/// nodes, interpolation from them.

#include "mpm/transfer.h"
#include "simd/kernel_units_only.h"

namespace furrow {
inline namespace FURROW_ISA {

// The four numbers of a node,
typedef double Vector4 __attribute__((vector_size(32)));
// and the same anywhere in memory.
typedef double Stored4 __attribute__((vector_size(32), aligned(8), may_alias));

/// Distance in memory, in doubles, from a node to the next along x and y.
struct Strides {
  explicit Strides(const GridView& grid)
      : y(4 * (static_cast<std::size_t>(grid.axis[2].cells) + 2)),
        x(y * (static_cast<std::size_t>(grid.axis[1].cells) + 2)) {}
  std::size_t y, x;
};

/// Sum over the particles of one cell for its 27 nodes, held in registers until the last of them.
struct CellSum {
  Vector4 node[stencil][stencil][stencil];

  /// Adds N_i base + sum_d slope_d flux_d at every node i of particle p; slope_d: Weights::slope
  /// along d times the values along the other axes.
  [[gnu::always_inline]] void add(const Weights& weights, std::size_t p, const Vector4& base,
                                  const Vector4* flux) {
    Vector4 value_z[stencil];
#pragma GCC unroll 3
    for (std::size_t k = 0; k < stencil; ++k)
      value_z[k] = weights.value[2][k][p] * base + weights.slope[2][k][p] * flux[2];
    add_rows(weights, p, value_z, flux);
  }

  /// The same without the first term.
  [[gnu::always_inline]] void add(const Weights& weights, std::size_t p, const Vector4* flux) {
    Vector4 value_z[stencil];
#pragma GCC unroll 3
    for (std::size_t k = 0; k < stencil; ++k) value_z[k] = weights.slope[2][k][p] * flux[2];
    add_rows(weights, p, value_z, flux);
  }

  [[gnu::always_inline]] void add_to(const GridView& grid, const Strides& stride,
                                     int first_node) const {
    double* corner = grid.sums + 4 * static_cast<std::size_t>(first_node);
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

/// Calls add(sum, particle) for the particles in turn, and adds the sum of those of one cell to the
/// nodes.
template <class Add>
[[gnu::always_inline]] inline void for_cells(const GridView& grid, const Weights& weights,
                                             std::size_t count, Add&& add) {
  const Strides stride(grid);
  for (std::size_t p = 0; p < count;) {
    const int first_node = weights.first_node[p];
    CellSum sum = {};
    do add(sum, p);
    while (++p < count && weights.first_node[p] == first_node);
    sum.add_to(grid, stride, first_node);
  }
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

}  // namespace FURROW_ISA
}  // namespace furrow
