// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Nodes of a surface with different numbers that are the same point of the body.

#include <array>
#include <vector>

#include "furrow/core/types.h"

namespace furrow {

/// Finds for every node the lowest number of all nodes at the same place, periodic images included.
/// @param period [m] of each axis; 0 for an axis without periodicity
/// @param tolerance [m] largest distance of nodes that are the same
std::vector<int> weld_nodes(const Matrix3X& x, const Vector3& period, double tolerance);

}  // namespace furrow
