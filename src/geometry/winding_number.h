// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Winding number of a surface about a point.

#include "furrow/geometry/surface.h"

namespace furrow {

/// Solid angle of the triangles seen from the point, over 4 pi: 1 inside and 0 outside of a closed
/// surface with outward triangles, in between for a surface with holes. After Van Oosterom and
/// Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125.
double winding_number(const Surface& surface, const Vector3& point);

}  // namespace furrow
