// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/geometry/closed_surface.h"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

std::string closedness_problem(const Surface& surface) {
  if (surface.triangles.empty()) return "there are no triangles";
  // lower and higher node: uses upwards, uses downwards
  std::map<std::pair<int, int>, std::pair<int, int>> edges;
  for (const Vector3i& nodes : surface.triangles)
    for (int corner = 0; corner < 3; ++corner) {
      const int from = nodes[corner], to = nodes[(corner + 1) % 3];
      auto& uses = edges[{std::min(from, to), std::max(from, to)}];
      ++(from < to ? uses.first : uses.second);
    }
  for (const auto& [edge, uses] : edges) {
    const auto [up, down] = uses;
    if (up == 1 && down == 1) continue;
    return fmt::format(
        "the edge of nodes {} and {} {}", edge.first, edge.second,
        up + down == 1   ? "belongs to one triangle: the surface is open there"
        : up + down == 2 ? "is run through twice in one direction: a triangle is turned inside out"
                         : "belongs to more than two triangles");
  }
  return "";
}

void check_closed(const Surface& surface, const std::string& body) {
  const std::string problem = closedness_problem(surface);
  if (!problem.empty())
    throw StateError(fmt::format("body '{}': its surface is not closed: {}", body, problem));
}

}  // namespace furrow
