// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/sheet_check.h"

#include <fmt/format.h>

#include "core/error.h"
#include "geometry/winding_number.h"
#include "mpm/continuum_terrain.h"

namespace furrow::coupling {

namespace {

constexpr double inside = 0.5;  // winding number

bool is_terrain(const Body& body) {
  return dynamic_cast<const ContinuumTerrain*>(&body) != nullptr;
}

/// The first node of the sheet inside of the surface; -1 for none.
Eigen::Index node_inside(const Surface& surface, const Surface& sheet) {
  const auto [lower, upper] = surface.bounds();
  for (Eigen::Index n = 0; n < sheet.x.cols(); ++n) {
    const Vector3 node = sheet.x.col(n);
    if ((node.array() > lower.array()).all() && (node.array() < upper.array()).all() &&
        winding_number(surface, node) > inside)
      return n;
  }
  return -1;
}

}  // namespace

void refuse_bodies_at_sheet(const std::vector<const Body*>& bodies, const std::string& where) {
  for (const Body* terrain : bodies)
    for (const Body* body : bodies) {
      if (!is_terrain(*terrain) || is_terrain(*body)) continue;
      const Surface& sheet = terrain->surface();
      const Eigen::Index node = node_inside(body->surface(), sheet);
      if (node < 0) continue;
      throw StateError(fmt::format(
          "{}: a body has come through the grains to the sheet of the terrain that carries them, "
          "at {:.4g} {:.4g} {:.4g} m, and does not feel it: it may touch grains only; make their "
          "layer deeper, and a trough wider than what it may sink and turn aside",
          where, sheet.x(0, node), sheet.x(1, node), sheet.x(2, node)));
    }
}

}  // namespace furrow::coupling
