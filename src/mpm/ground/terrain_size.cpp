// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/ground/terrain_size.h"

#include <algorithm>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/core/machine.h"
#include "furrow/mpm/grid/grid.h"

namespace furrow {

namespace {

// Measured, of a cap law in contact: 55 numbers of each, room to grow and to sort, candidates.
constexpr double bytes_of_particle = 1040.0;
constexpr double gibibyte = 1024.0 * 1024.0 * 1024.0;

double cells_below_surface(const TerrainParameters& parameters) {
  AxisLayout below = parameters.z;
  below.upper = parameters.surface;
  below.fine_upper = std::min(below.fine_upper, below.upper);
  return Axis::cell_count(below);
}

/// Number of nodes of all velocity fields, on the rank with the largest block.
double nodes_of_a_rank(const TerrainParameters& parameters, int ranks) {
  const double x = Axis::cell_count(parameters.x), y = Axis::cell_count(parameters.y);
  const BlockLayout blocks = parameters.blocks ? *parameters.blocks : choose_layout(ranks, x, y);
  return parameters.velocity_fields() * columns_of_largest(blocks, x, y) *
         (Axis::cell_count(parameters.z) + 2.0);
}

}  // namespace

TerrainSize size_of(const TerrainParameters& parameters) {
  const double x = Axis::cell_count(parameters.x), y = Axis::cell_count(parameters.y),
               z = Axis::cell_count(parameters.z);
  const std::array<int, 3>& per_cell = parameters.particles_per_cell;
  const auto& trough = parameters.trough;
  const double left_out =
      trough ? x * (trough->width / parameters.y.cell) * (trough->depth / parameters.z.cell) : 0.0;
  return {x * y * z, (x * y * cells_below_surface(parameters) - left_out) * per_cell[0] *
                         per_cell[1] * per_cell[2]};
}

void check_memory(const TerrainParameters& parameters, const Communicator& ranks,
                  const std::string& where) {
  const TerrainSize size = size_of(parameters);
  const int here = ranks.on_this_machine();
  // boundaries and messages come on top
  const double needed = here * (Grid::bytes_of_node * nodes_of_a_rank(parameters, ranks.size()) +
                                bytes_of_particle * size.particles / ranks.size());
  const double usable = usable_memory(here);
  // the machine that is worst off speaks for all
  if (!(ranks.max(needed / usable) > 1.0)) return;
  throw InputError(
      where,
      fmt::format("would have {:.3g} cells and {:.3g} particles, about {:.3g} GiB on this machine",
                  size.cells, size.particles, needed / gibibyte),
      fmt::format("the {:.3g} GiB that its {} rank(s) may use", usable / gibibyte, here),
      "use larger cells, let them grow outside of a fine stretch, or make length, width, depth or "
      "clearance_above smaller");
}

}  // namespace furrow
