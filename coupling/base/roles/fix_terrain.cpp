// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/base/roles/fix_terrain.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "coupling/liggghts/checkpoint_file.h"
#include "furrow/mpm/terrain_outputs.h"

namespace furrow::coupling {

namespace {

/// Cells of an axis within a span, fractions included.
double cells_within(const Axis& axis, double lower, double upper) {
  double count = 0.0;
  for (int c = 0; c < axis.cells(); ++c)
    count += std::max(0.0, std::min(axis.knot(c + 1), upper) - std::max(axis.knot(c), lower)) /
             axis.length(c);
  return count;
}

}  // namespace

void FixTerrain::checkpoint(Checkpoint& state) {
  std::string set = set_being_written();
  state.value("files_of_ranks", set);
  const std::unique_ptr<RankFiles> files = rank_files(*lmp, set, id);
  terrain().keep_values_in(*files);
  FixBody::checkpoint(state);
  close_rank_files(*lmp, *files);
}

std::pair<double, double> FixTerrain::extent(int direction) const {
  const Axis& axis = terrain().grid().axis(direction);
  return {axis.lower(), direction == 2 ? options().number("surface") : axis.upper()};
}

std::vector<GivenGravity> FixTerrain::gravities() const {
  return {{options().where("gravity"), terrain().parameters().gravity}};
}

Vector3 FixTerrain::shortest_cell() const {
  const Grid& grid = terrain().grid();
  return {grid.axis(0).shortest(), grid.axis(1).shortest(), grid.axis(2).shortest()};
}

/// Cells along x are those around the body that the terrain follows.
Vector3 FixTerrain::cells_across(const Vector3& lower, const Vector3& upper) const {
  const Grid& grid = terrain().grid();
  return {(upper.x() - lower.x()) / grid.axis(0).shortest(),
          symmetry_factor() * cells_within(grid.axis(1), lower.y(), upper.y()),
          cells_within(grid.axis(2), lower.z(), upper.z())};
}

/// The upper layer is the one that a body touches.
Terrain::KnownContact FixTerrain::known_contact() const {
  const TerrainLayer& top = terrain().parameters().layers.front();
  return {top.name, top.contact};
}

void FixTerrain::tilt_gravity(const Matrix3& tilt) {
  terrain().set_gravity(tilt * terrain().parameters().gravity);
}

std::vector<ParticleGroup*> FixTerrain::particle_groups() {
  std::vector<ParticleGroup*> groups;
  for (ParticleGroup& group : terrain().unsynchronised_groups()) groups.push_back(&group);
  return groups;
}

std::vector<Channel> FixTerrain::channels() const { return terrain_outputs().channels(); }

std::vector<double> FixTerrain::values() {
  TerrainReading reading(terrain());
  return terrain_outputs().values(reading);
}

bool FixTerrain::contains(const Vector3& point) const {
  for (int a = 0; a < 3; ++a) {
    const auto [lower, upper] = extent(a);
    if (!(point[a] > lower && point[a] < upper)) return false;
  }
  const std::optional<Trough>& trough = terrain().parameters().trough;
  if (!trough) return true;
  const auto [side, other_side] = extent(1);
  return std::abs(point.y() - 0.5 * (side + other_side)) > 0.5 * trough->width ||
         point.z() < extent(2).second - trough->depth;
}

}  // namespace furrow::coupling
