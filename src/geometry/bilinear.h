// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Values at the nodes of a map, linear between them along x and along y.

#include <algorithm>
#include <utility>

#include "furrow/core/types.h"

namespace furrow {

/// Value at a place; beyond the outer nodes that of the nearest edge.
/// @param first    the node of the lowest x and y [m]; @param spacing  of the nodes [m]
/// @param node  value of a column and a row
template <class Node>
double bilinear(const Vector2& place, const Vector2& first, const Vector2& spacing, int columns,
                int rows, Node&& node) {
  // The node below a coordinate, and the place between it and the next as 0 to 1.
  const auto between = [&](int axis, int count) {
    const double at = std::clamp((place[axis] - first[axis]) / spacing[axis], 0.0, count - 1.0);
    const int below = std::min(static_cast<int>(at), std::max(0, count - 2));
    return std::pair(below, at - below);
  };
  const auto [i, u] = between(0, columns);
  const auto [j, v] = between(1, rows);
  const int right = std::min(i + 1, columns - 1), above = std::min(j + 1, rows - 1);
  return (1.0 - v) * ((1.0 - u) * node(i, j) + u * node(right, j)) +
         v * ((1.0 - u) * node(i, above) + u * node(right, above));
}

}  // namespace furrow
