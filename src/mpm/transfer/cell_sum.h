// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Sums of particles to the 27 nodes of their cell, with the four numbers of a node as one vector.

#include "furrow/mpm/transfer/nodes.h"

namespace furrow {
inline namespace FURROW_ISA {

/// Sum over the particles of one cell for its 27 nodes, held in registers until the last of them.
/// Particle p adds N_i base + sum_d slope_d flux_d to every node i; slope_d: Weights::slope along d
/// times the values along the other axes.
struct CellSum {
  using Carried = Vector4;
  [[gnu::always_inline]] static Carried carry(const double* four) {
    return *reinterpret_cast<const Stored4*>(four);
  }

  Vector4 node[stencil][stencil][stencil];

  [[gnu::always_inline]] void add(const Weights& weights, std::size_t p, const Vector4& base,
                                  const Vector4* flux) {
    Vector4 value_z[stencil];
#pragma GCC unroll 3
    for (std::size_t k = 0; k < stencil; ++k)
      value_z[k] = weights.value[2][k][p] * base + weights.slope[2][k][p] * flux[2];
    add_rows(weights, p, value_z, flux);
  }

  /// Adds a particle without the first term.
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

#ifdef __AVX512F__

// Two nodes side by side, and the same anywhere in memory.
typedef double Vector8 __attribute__((vector_size(64)));
typedef double Stored8 __attribute__((vector_size(64), aligned(8), may_alias));

[[gnu::always_inline]] inline Vector8 both(const Vector4& v) {
  return __builtin_shufflevector(v, v, 0, 1, 2, 3, 4, 5, 6, 7);
}
[[gnu::always_inline]] inline Vector8 all_of(double a) { return Vector8(_mm512_set1_pd(a)); }
/// The lower half of a and the upper half of b.
[[gnu::always_inline]] inline Vector8 halves(const Vector8& a, const Vector8& b) {
  return Vector8(_mm512_mask_mov_pd(a, 0xF0, b));
}
[[gnu::always_inline]] inline Vector4 lower(const Vector8& v) {
  return __builtin_shufflevector(v, v, 0, 1, 2, 3);
}
[[gnu::always_inline]] inline Vector4 upper(const Vector8& v) {
  return __builtin_shufflevector(v, v, 4, 5, 6, 7);
}

/// Sum in a cell with two nodes in a register: the two lower nodes along z are neighbours in
/// memory, the upper ones are paired along x. The numbers of a particle come twice side by side.
struct PairedCellSum {
  using Carried = Vector8;
  /// From the four numbers of a vector in memory: a load alone, no shuffle.
  [[gnu::always_inline]] static Carried carry(const double* four) {
    return Vector8(_mm512_broadcast_f64x4(_mm256_loadu_pd(four)));
  }

  Vector8 low[stencil][stencil];  // at i, j: k = 0 and 1
  Vector8 top[stencil];           // at j, k = 2: i = 0 and 1
  Vector4 last[stencil];          // at j, k = 2: i = 2

  [[gnu::always_inline]] void add(const Weights& weights, std::size_t p, const Vector8& base,
                                  const Vector8* flux) {
    const auto& w = weights.value[2];
    const auto& g = weights.slope[2];
    const Vector8 low_w = halves(all_of(w[0][p]), all_of(w[1][p])),
                  low_g = halves(all_of(g[0][p]), all_of(g[1][p]));
    add_rows(weights, p, low_w, low_w * base + low_g * flux[2], w[2][p] * base + g[2][p] * flux[2],
             flux);
  }

  [[gnu::always_inline]] void add(const Weights& weights, std::size_t p, const Vector8* flux) {
    const auto& w = weights.value[2];
    const auto& g = weights.slope[2];
    add_rows(weights, p, halves(all_of(w[0][p]), all_of(w[1][p])),
             halves(all_of(g[0][p]), all_of(g[1][p])) * flux[2], g[2][p] * flux[2], flux);
  }

  [[gnu::always_inline]] void add_to(const GridView& grid, const Strides& stride,
                                     int first_node) const {
    double* corner = grid.sums + 4 * static_cast<std::size_t>(first_node);
#pragma GCC unroll 3
    for (std::size_t j = 0; j < stencil; ++j) {
      const Vector4 top_nodes[stencil] = {lower(top[j]), upper(top[j]), last[j]};
#pragma GCC unroll 3
      for (std::size_t i = 0; i < stencil; ++i) {
        double* node = corner + i * stride.x + j * stride.y;
        *reinterpret_cast<Stored8*>(node) += low[i][j];
        *reinterpret_cast<Stored4*>(node + 8) += top_nodes[i];
      }
    }
  }

 private:
  /// @param low_w  N of the nodes k = 0 and 1 along z
  /// @param low_z, top_z  what the nodes k = 0 and 1, and k = 2, get along z
  [[gnu::always_inline]] void add_rows(const Weights& weights, std::size_t p, const Vector8& low_w,
                                       const Vector8& low_z, const Vector8& top_z,
                                       const Vector8* flux) {
    const double top_w = weights.value[2][2][p];
    const Vector8 low_x = low_w * flux[0], low_y = low_w * flux[1];
    const Vector8 top_x = top_w * flux[0], top_y = top_w * flux[1];
    Vector8 w[stencil], g[stencil];
#pragma GCC unroll 3
    for (std::size_t i = 0; i < stencil; ++i) {
      w[i] = all_of(weights.value[0][i][p]);
      g[i] = all_of(weights.slope[0][i][p]);
      add_row(weights, p, w[i] * low_z + g[i] * low_x, w[i] * low_y, low[i]);
    }
    const Vector8 pair_w = halves(w[0], w[1]), pair_g = halves(g[0], g[1]);
    add_row(weights, p, pair_w * top_z + pair_g * top_x, pair_w * top_y, top);
    const Vector4 last_w = lower(w[2]), last_g = lower(g[2]);
    add_row(weights, p, last_w * lower(top_z) + last_g * lower(top_x), last_w * lower(top_y), last);
  }

  template <class Vector>
  [[gnu::always_inline]] static void add_row(const Weights& weights, std::size_t p,
                                             const Vector& value, const Vector& y_part,
                                             Vector* row) {
#pragma GCC unroll 3
    for (std::size_t j = 0; j < stencil; ++j) {
      row[j] += weights.value[1][j][p] * value;
      row[j] += weights.slope[1][j][p] * y_part;
    }
  }
};

/// Writes the vectors (a, b, c, 0) of eight particles one after the other.
[[gnu::always_inline]] inline void interleave(const Vector8& a, const Vector8& b, const Vector8& c,
                                              double* vectors) {
  const Vector8 zero = {};
  const Vector8 ab[2] = {__builtin_shufflevector(a, b, 0, 8, 1, 9, 2, 10, 3, 11),
                         __builtin_shufflevector(a, b, 4, 12, 5, 13, 6, 14, 7, 15)};
  const Vector8 c0[2] = {__builtin_shufflevector(c, zero, 0, 8, 1, 8, 2, 8, 3, 8),
                         __builtin_shufflevector(c, zero, 4, 8, 5, 8, 6, 8, 7, 8)};
  Stored8* pairs = reinterpret_cast<Stored8*>(vectors);
  for (int h = 0; h < 2; ++h) {
    pairs[2 * h] = __builtin_shufflevector(ab[h], c0[h], 0, 1, 8, 9, 2, 3, 10, 11);
    pairs[2 * h + 1] = __builtin_shufflevector(ab[h], c0[h], 4, 5, 12, 13, 6, 7, 14, 15);
  }
}

#else

using PairedCellSum = CellSum;

#endif

/// Calls add(sum, particle) for the particles in turn, and adds the sum of those of one cell to the
/// nodes.
template <class Add>
[[gnu::always_inline]] inline void for_cells(const GridView& grid, const Weights& weights,
                                             std::size_t count, Add&& add) {
  const Strides stride(grid);
  for (std::size_t p = 0; p < count;) {
    const std::size_t end = end_of_cell(weights, p, count);
    PairedCellSum sum = {};
    const int first_node = weights.first_node[p];
    for (; p < end; ++p) add(sum, p);
    sum.add_to(grid, stride, first_node);
  }
}

}  // namespace FURROW_ISA
}  // namespace furrow
