// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/geometry/winding_number.h"

#include <cmath>

namespace furrow {

double winding_number(const Surface& surface, const Vector3& point) {
  double half_angles = 0.0;
  for (const Vector3i& nodes : surface.triangles) {
    const Vector3 a = surface.x.col(nodes[0]) - point, b = surface.x.col(nodes[1]) - point,
                  c = surface.x.col(nodes[2]) - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    half_angles +=
        std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return half_angles / (2.0 * pi);
}

}  // namespace furrow
