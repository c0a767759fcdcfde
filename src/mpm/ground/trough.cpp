// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/ground/trough.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

constexpr double round_off = 1e-6;  // of what particles are apart
constexpr std::size_t min_cells_across = 3, min_cells_of_ground = 2;

/// A length from which and to which particles are counted: what is nearest, and how far it is off.
struct NearestCount {
  std::size_t count;  // of particles within the length
  double length;      // of as many [m]
  double spacing;     // of particles there [m]
};

void refuse_between(double length, const NearestCount& nearest, double step, const char* what,
                    const std::string& where) {
  if (std::abs(length - nearest.length) <= round_off * nearest.spacing) return;
  const double other = nearest.length + (length > nearest.length ? step : -step);
  throw InputError(
      where,
      fmt::format("has a trough {:.6g} m {}, which ends inside of a particle's part of "
                  "the ground",
                  length, what),
      "an end between two particles",
      fmt::format("make it {:.6g} or {:.6g} m {}, or change 'cell'",
                  std::min(nearest.length, other), std::max(nearest.length, other), what));
}

/// Rows on either side of the middle of the ground, up to the trough's half width.
NearestCount rows_beside_middle(const TerrainParameters& parameters, const Axis& y) {
  const int per_cell = parameters.particles_per_cell[1];
  const double middle = 0.5 * (y.lower() + y.upper()), half = 0.5 * parameters.trough->width;
  NearestCount nearest{0, 0.0, y.shortest() / per_cell};
  double off = std::abs(y.upper() - middle - half);
  for (int cell = 0; cell < y.cells(); ++cell)
    for (int j = 0; j < per_cell; ++j) {
      const double end = y.knot(cell) + j * y.length(cell) / per_cell - middle;
      if (std::abs(-end - half) > off) continue;
      off = std::abs(-end - half);
      nearest = {static_cast<std::size_t>(cell * per_cell + j), -2.0 * end,
                 y.length(cell) / per_cell};
    }
  return nearest;
}

NearestCount levels_down_to(double depth, const std::vector<ParticleLevel>& levels) {
  NearestCount nearest{0, 0.0, 2.0 * levels.front().half};
  double end = 0.0;
  for (std::size_t n = 0; n < levels.size(); ++n) {
    end += 2.0 * levels[n].half;
    if (std::abs(end - depth) < std::abs(nearest.length - depth))
      nearest = {n + 1, end, 2.0 * levels[n].half};
  }
  return nearest;
}

void refuse_less(std::size_t particles, int per_cell, std::size_t min_cells, const char* place,
                 const char* remedy, const std::string& where) {
  const double cells = static_cast<double>(particles) / per_cell;
  if (cells >= static_cast<double>(min_cells)) return;
  throw InputError(where, fmt::format("has {:.3g} cell(s) {} its trough", cells, place),
                   fmt::format("at least {}", min_cells), remedy);
}

}  // namespace

TroughPlace place_trough(const TerrainParameters& parameters, const Axis& y,
                         const std::vector<ParticleLevel>& levels, const std::string& where) {
  if (!parameters.trough) return {};
  const auto [width, depth] = *parameters.trough;
  const std::array<int, 3>& per_cell = parameters.particles_per_cell;
  const std::size_t rows = static_cast<std::size_t>(y.cells() * per_cell[1]);
  const NearestCount side = rows_beside_middle(parameters, y),
                     bottom = levels_down_to(depth, levels);
  const TroughPlace place{side.count, rows - side.count, bottom.count};
  refuse_less(place.to_row - place.from_row, per_cell[1], min_cells_across, "across",
              "make the trough wider, or 'cell' smaller", where);
  refuse_less(place.from_row, per_cell[1], min_cells_of_ground, "on either side of",
              "make 'width' larger, or the trough narrower", where);
  refuse_less(levels.size() - place.levels, per_cell[2], min_cells_of_ground, "below",
              "make 'depth' larger, or the trough less deep", where);
  refuse_between(width, side, 2.0 * side.spacing, "wide", where);
  refuse_between(depth, bottom, bottom.spacing, "deep", where);
  return place;
}

}  // namespace furrow
