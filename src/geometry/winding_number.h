// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// How often a surface goes round a point.

#include "geometry/surface.h"

namespace furrow {

/// 1 inside and 0 outside of a closed surface with outward triangles; in between for one with
/// holes: the solid angle that the triangles take, seen from the point, over 4 pi. After Van
/// Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125.
double winding_number(const Surface& surface, const Vector3& point);

}  // namespace furrow
