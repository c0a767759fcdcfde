// SPDX-License-Identifier: GPL-2.0-or-later
#include "mpm/contact/penalty_law.h"

#include <fmt/format.h>

#include "core/error.h"

namespace furrow {

/// A particle of mass rho d^3 on its spring s M d, d the spacing of the particles: omega dt =
/// sqrt(s) c dt/d, and a leapfrog needs less than 2.
void PenaltyLaw::check(const TerrainParameters& terrain, const std::string& where) const {
  const auto& per_cell = terrain.particles_per_cell;
  const int particles = *std::max_element(per_cell.begin(), per_cell.end());
  if (std::sqrt(stiffness_) * terrain.cfl * particles >= 2.0)
    throw InputError(
        where,
        fmt::format(
            "has a stiffness of {}, too stiff for steps of cfl {} with {} particles along a cell",
            stiffness_, terrain.cfl, particles),
        "sqrt(stiffness) x cfl x particles below 2", "lower the stiffness, or the ground's cfl");
}

}  // namespace furrow
