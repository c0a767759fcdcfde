// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/discontinuities/slide_contact.h"

#include <algorithm>

namespace furrow {

double SlideContact::apply(Grid& grid, const Boundary& walls, const NodeBlock& local,
                           const NodeBlock& owned) const {
  double loss = 0.0;
  for (int i = local.x.from; i < local.x.to; ++i)
    for (int j = local.y.from; j < local.y.to; ++j)
      for (int k = 0; k < grid.nodes(2); ++k) {
        NodeMotion& inner = grid.motion(i, j, k, 0);
        NodeMotion& outer = grid.motion(i, j, k, 1);
        if (!(inner.mass > 0.0) || !(outer.mass > 0.0)) continue;
        const Vector3 x(grid.axis(0).node(i), grid.axis(1).node(j), grid.axis(2).node(k));
        std::array<bool, 3> is_free;
        for (int c = 0; c < 3; ++c)
          is_free[static_cast<std::size_t>(c)] = !walls.is_fixed(grid, {i, j, k}, c);
        const double at_node = apply(inner, outer, surface_.normal(x), is_free);
        if (owned.contains(i, j)) loss += at_node;
      }
  return loss;
}

/// @param is_free  components of the velocity that no wall holds
double SlideContact::apply(NodeMotion& inner, NodeMotion& outer, const Vector3& normal,
                           const std::array<bool, 3>& is_free) const {
  constexpr double along_wall = 1e-6;  // a normal shorter than that has no part along the wall
  Vector3 n = Vector3::Zero(), sliding = Vector3::Zero();
  for (int c = 0; c < 3; ++c) {
    if (!is_free[static_cast<std::size_t>(c)]) continue;
    n[c] = normal[c];
    sliding[c] = inner.velocity[c] - outer.velocity[c];
  }
  const double length = n.norm();
  if (length < along_wall) return 0.0;
  n /= length;
  const double approach = sliding.dot(n);
  if (!(approach > 0.0)) return 0.0;
  sliding -= approach * n;
  const double speed = sliding.norm();
  const double stopped = std::min(speed, surface_.friction * approach);
  const Vector3 change = approach * n + (speed > 0.0 ? stopped / speed : 0.0) * sliding;
  const double inner_share = inner.mass / (inner.mass + outer.mass);
  for (int c = 0; c < 3; ++c) {
    inner.velocity[c] -= (1.0 - inner_share) * change[c];
    outer.velocity[c] += inner_share * change[c];
  }
  return inner_share * outer.mass * stopped * (speed - stopped);
}

}  // namespace furrow
