// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/contact/contact_checks.h"

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/geometry/triangle_search.h"

namespace furrow {

namespace {

constexpr double position_tolerance = 1e-6;  // of the surface's size

}  // namespace

void check_within_terrain(const Surface& surface, const Grid& grid) {
  const auto [low, high] = surface.bounds();
  const Vector3 middle = 0.5 * (low + high);
  // the side of a half model lies in the plane of symmetry, under the middle of the wheel
  const double tolerance = position_tolerance * (high - low).norm();
  for (int a = 0; a < 2; ++a) {
    const Axis& axis = grid.axis(a);
    if (middle[a] < axis.lower() - tolerance || middle[a] > axis.upper() + tolerance)
      throw StateError(
          fmt::format("the middle of the body is at {} = {:.4g} m, beyond the ground that reaches "
                      "from {:.4g} to {:.4g} m; give the ground more length, or let it move with "
                      "the body",
                      a == 0 ? 'x' : 'y', middle[a], axis.lower(), axis.upper()));
  }
}

void check_no_overlap(const Surface& surface, const std::vector<ParticleGroup>& groups) {
  if (!surface.is_closed()) return;
  const auto [low, high] = surface.bounds();
  for (const ParticleGroup& group : groups)
    for (std::size_t p = 0; p < group.particles.size(); ++p) {
      const Vector3 x = group.particles.position(p);
      if ((x.array() > low.array()).all() && (x.array() < high.array()).all() &&
          encloses(surface, x))
        throw StateError(
            fmt::format("the ground at {:.4g} {:.4g} {:.4g} m is inside of the body at the start; "
                        "start above the ground",
                        x[0], x[1], x[2]));
    }
}

}  // namespace furrow
