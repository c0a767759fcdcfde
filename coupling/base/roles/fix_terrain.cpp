// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/base/roles/fix_terrain.h"

#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "coupling/liggghts/checkpoint_file.h"

namespace furrow::coupling {

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
