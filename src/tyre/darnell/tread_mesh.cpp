// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/darnell/tread_mesh.h"

#include <cmath>

namespace furrow {

TreadMesh make_tread_mesh(const TreadParameters& tread, int across, int around, bool half) {
  TreadMesh mesh;
  mesh.grid = {around, half ? across / 2 : across, half};
  const int rows = mesh.grid.rows;
  const auto node = [&](int i, int j) { return mesh.grid.node(i, j); };
  mesh.x.resize(3, mesh.grid.count());
  for (int i = 0; i < around; ++i)
    for (int j = 0; j <= rows; ++j) {
      const double angle = 2.0 * pi * i / around;
      const double lateral = half ? double(j) / rows : 2.0 * j / rows - 1.0;  // of half the width
      const double radius = tread.radius - tread.crown * lateral * lateral;
      mesh.x.col(node(i, j)) << radius * std::sin(angle), tread.half_width * lateral,
          -radius * std::cos(angle);
      if (j < rows)
        mesh.quads.push_back({node(i, j), node(i, j + 1), node(i + 1, j + 1), node(i + 1, j)});
    }
  return mesh;
}

}  // namespace furrow
