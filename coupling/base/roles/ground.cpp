// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/base/roles/ground.h"

#include <algorithm>

#include <fmt/format.h>

#include "coupling/liggghts/styles/fixes_of.h"

namespace furrow::coupling {

namespace {

constexpr double level_tolerance = 1e-3;  // of the body's size
constexpr double shared_face = 1e-6;      // of a cell

}  // namespace

double size_of_body(const Body& body) {
  const auto [lower, upper] = body.surface().bounds();
  return (upper - lower).maxCoeff();
}

Level exact_level(const Body& body, double z, const std::string& what) {
  return {z, level_tolerance * size_of_body(body), what};
}

std::optional<Level> Terrain::level_under(const Body& body) const {
  return exact_level(body, level(), fmt::format("the surface of terrain '{}'", as_fix(*this).id));
}

bool overlap(const Terrain& a, const Terrain& b) {
  const Vector3 cell = a.shortest_cell();
  for (int axis = 0; axis < 3; ++axis) {
    const auto [lower, upper] = a.extent(axis);
    const auto [other_lower, other_upper] = b.extent(axis);
    if (std::min(upper, other_upper) - std::max(lower, other_lower) <= shared_face * cell[axis])
      return false;
  }
  return true;
}

}  // namespace furrow::coupling
