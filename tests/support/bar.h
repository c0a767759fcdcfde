// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A closed box as a surface.

#include "furrow/geometry/surface.h"

namespace furrow::test {

/// About the middle of its lower end.
inline Surface bar(const Vector3& size) {
  Surface surface;
  surface.resize(8);
  for (int n = 0; n < 8; ++n)
    surface.x.col(n) =
        Vector3((n & 1) ? 0.5 : -0.5, (n & 2) ? 0.5 : -0.5, (n & 4) ? 1.0 : 0.0).cwiseProduct(size);
  const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : quads) {
    surface.triangles.push_back({q[0], q[1], q[2]});
    surface.triangles.push_back({q[0], q[2], q[3]});
  }
  return surface;
}

}  // namespace furrow::test
