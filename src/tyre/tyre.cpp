// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/tyre.h"

#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

Relaxation Tyre::settle(RigidPlane* plane, const SettleOptions& options) {
  const Relaxation result = relax(plane, options);
  if (!result.converged)
    throw StateError(
        fmt::format("tyre: not at rest after {} steps of relaxation; the largest unbalanced force "
                    "is {:.3g} of the pressure's force on a node, allowed {:.3g}",
                    options.max_steps, result.residual, options.tolerance));
  return result;
}

NaturalModes Tyre::natural_modes(const RigidPlane* plane, int count) {
  if (half_model())
    throw InputError("natural modes: the tyre", "is a half model, which has only symmetric modes",
                     "a whole tyre", "leave out 'half'");
  std::vector<int> held;
  if (plane)
    for (int node = 0; node < tread_grid().count(); ++node)
      if (plane->pressure()[node] > 0.0) held.push_back(node);
  return modes_with(held, count);
}

double Tyre::lowest_tread_height() const {
  return surface().x.row(2).head(tread_grid().count()).minCoeff();
}

double Tyre::crown_radius() const {
  const TreadGrid& grid = tread_grid();
  double sum = 0.0;
  for (int i = 0; i < grid.around; ++i) {
    const Vector3 arm = surface().x.col(grid.node(i, grid.middle_line())) - centre();
    sum += std::hypot(arm.x(), arm.z()) / grid.around;
  }
  return sum;
}

}  // namespace furrow
