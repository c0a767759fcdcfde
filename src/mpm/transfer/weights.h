// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Weights of a particle's 27 nodes: values of the B-splines and the second factors of the affine
/// transfers, found for a batch of particles at once in loops that the compiler vectorises over
/// particles.

#include "furrow/mpm/transfer/transfer.h"
#include "furrow/simd/kernel_units_only.h"

namespace furrow {
inline namespace FURROW_ISA {

/// Meaning of Weights::slope (transfer.h).
enum class Slope {
  moment,   // N d, for momentum and motion
  gradient  // G, for force and strain
};

/// Weights of a particle outside of the run of regular cells, by the tables of the axis.
/// @return its cell
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
  if (kind == Slope::gradient && axis.irregular[c]) {
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

/// Number of positions where no particle of this rank may be; not a number counts too.
inline std::size_t count_outside(const GridView& grid, const double* const* position,
                                 std::size_t count) {
  int outside = 0;
  for (std::size_t p = 0; p < count; ++p) {
    int inside = 1;
    for (int a = 0; a < 3; ++a)
      inside &= static_cast<int>(position[a][p] >= grid.axis[a].particles_lower) &
                static_cast<int>(position[a][p] <= grid.axis[a].particles_upper);
    outside += 1 - inside;
  }
  return static_cast<std::size_t>(outside);
}

template <Slope kind>
void find_batch_weights(const GridView& grid, const double* const* position, std::size_t count,
                        Weights& weights) {
  int cell[3][batch];
  int irregular[batch];
  for (int a = 0; a < 3; ++a) {
    const AxisView& axis = grid.axis[a];
    const double* x = position[a];
    // Weights as if all cells were regular: the splines are those of unit cells, D = h^2/4. No
    // table, so that the compiler vectorises.
    const double h = axis.regular_length;
    const double per_length = 1.0 / h;
    const double inverse_spread = 4.0 * per_length * per_length;
    const double scale = kind == Slope::moment ? h : h * inverse_spread;
    // Cells of the same length that end the axis differ in one spline; where G = grad N is asked
    // for they are done here too.
    constexpr int none = -(1 << 30);  // no cell, and no position counts as in it
    const int last = axis.cells - 1;
    const auto is_like_run = [&](int c) {
      const double difference = axis.knot[c + 1] - axis.knot[c] - h;
      return difference < 1e-9 * h && difference > -1e-9 * h;
    };
#ifdef __AVX512F__  // without its masks the selections cost more than the table
    constexpr bool here_too = kind == Slope::gradient;
#else
    constexpr bool here_too = false;
#endif
    const bool here = here_too && axis.regular_to > axis.regular_from;
    const int first_cell = here && axis.regular_from == 1 && is_like_run(0) ? 0 : none;
    const int last_cell = here && axis.regular_to == last && is_like_run(last) ? last : none;
    int any_irregular = 0;
    for (std::size_t p = 0; p < count; ++p) {
      const double from_start = (x[p] - axis.regular_start) * per_length;
      const double in_cells = from_start + axis.regular_from;
      const int c = static_cast<int>(in_cells);
      const double f = in_cells - c, g = 1.0 - f;
      const bool is_first = here_too && c == first_cell, is_last = here_too && c == last_cell;
      const double u0 = is_first ? g : 0.5 * g, u2 = is_last ? f : 0.5 * f;
      const double w0 = u0 * g, w2 = u2 * f, w1 = 1.0 - w0 - w2;
      weights.value[a][0][p] = w0;
      weights.value[a][1][p] = w1;
      weights.value[a][2][p] = w2;
      const bool grad = is_first | is_last;
      const double s0 = grad ? -2.0 * per_length * u0 : w0 * (-0.5 - f) * scale;
      const double s2 = grad ? 2.0 * per_length * u2 : w2 * (1.5 - f) * scale;
      weights.slope[a][0][p] = s0;
      weights.slope[a][1][p] = grad ? -s0 - s2 : w1 * (0.5 - f) * scale;
      weights.slope[a][2][p] = s2;
      if (kind == Slope::moment) weights.inverse_spread[a][p] = inverse_spread;
      cell[a][p] = c;
      irregular[p] = (static_cast<int>(from_start < 0.0) & static_cast<int>(!is_first)) |
                     (static_cast<int>(c >= axis.regular_to) & static_cast<int>(!is_last));
      any_irregular |= irregular[p];
    }
    if (any_irregular)
      for (std::size_t p = 0; p < count; ++p)
        if (irregular[p]) cell[a][p] = find_weights_by_table<kind>(axis, a, x[p], p, weights);
  }
  const int ny = grid.columns_along_y, nz = grid.axis[2].cells + 2;
  const int first_x = grid.first_column[0], first_y = grid.first_column[1];
  for (std::size_t p = 0; p < count; ++p)
    weights.first_node[p] = ((cell[0][p] - first_x) * ny + cell[1][p] - first_y) * nz + cell[2][p];
}

/// View of `count` particles from `first` on. Members that a view leaves out stay null.
inline ParticleView sub_view(const ParticleView& all, std::size_t first, std::size_t count) {
  const auto advance = [first](auto*& values, std::size_t per_particle) {
    if (values) values += per_particle * first;
  };
  ParticleView some = all;
  some.size = count;
  for (const double*& x : some.quadrature_position) advance(x, 1);
  for (double*& x : some.position) advance(x, 1);
  advance(some.velocity, 4);
  advance(some.affine, 12);
  advance(some.residual, 8);
  advance(some.cell, 1);
  advance(some.volume, 1);
  advance(some.volume_ratio, 1);
  for (const double*& s : some.stress) advance(s, 1);
  return some;
}

/// Calls visit(particles of the batch, index of its first) for all batches.
template <class Visit>
void for_batches(const ParticleView& particles, Visit&& visit) {
  for (std::size_t first = 0; first < particles.size; first += batch)
    visit(
        sub_view(particles, first, particles.size - first < batch ? particles.size - first : batch),
        first);
}

inline void find_weights(const GridView& grid, const ParticleView& all, Weights* weights) {
  for_batches(all, [&](const ParticleView& particles, std::size_t first) {
    find_batch_weights<Slope::gradient>(grid, particles.quadrature_position, particles.size,
                                        weights[first / batch]);
  });
}

}  // namespace FURROW_ISA
}  // namespace furrow
