// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The width b of a contact patch in Bekker's k_c/b (theory: scm, eq. 2).

#include <vector>

#include "furrow/core/types.h"

namespace furrow {

/// Perimeter of the convex hull of points, which it sorts [m].
double hull_perimeter(std::vector<Vector2>& points, std::vector<Vector2>& hull);

/// 2 A/P: half the side of a square, the radius of a circle, the width of a long strip.
/// @param area  of the patch [m^2]
inline double contact_width(double area, double perimeter) { return 2.0 * area / perimeter; }

}  // namespace furrow
