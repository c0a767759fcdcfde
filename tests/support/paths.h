// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Paths for tests: laws from short lists of keys, steps of given logarithmic strain, components
/// held at given stress.

#include <array>
#include <memory>
#include <string>

#include "furrow/material/registry.h"
#include "furrow/testing/material_text.h"
#include "furrow/testing/stretch.h"

namespace furrow::testing_paths {

/// "law key value value key value ..."
inline std::unique_ptr<Material> material_of(const std::string& text) {
  return material_of_text(text);
}

/// McCormick Ranch sand, [Shoop2001] Tables 4 and 5. The density, not given there, only enters
/// through inertia.
inline std::string mccormick_sand(const std::string& more = "") {
  return "drucker_prager_cap density 1800 d 1.194e6 beta 14.56 R 0.1 eps_vol_pl_0 0.001 elasticity "
         "linear E 689e6 nu 0.25 "
         "hardening table p 0.138e6 0.172e6 0.434e6 0.896e6 1.655e6 2.758e6 4.137e6 6.895e6 "
         "13.447e6 "
         "eps_vol_pl 0 0.005 0.01 0.02 0.03 0.04 0.05 0.06 0.1 interpolation linear beyond "
         "extrapolate " +
         more;
}

using furrow::stretch;

inline Vector6 strain_of(double xx, double yy, double zz, double xz = 0) {
  return (Vector6() << xx, yy, zz, 0, 0, xz).finished();
}

/// One step with the components of `strain`, except that the normal components marked in `held`
/// take whatever keeps their stress at `target` (Newton's method with differences). Returns the
/// strain increment.
/// @throws std::runtime_error where the iteration does not converge
Vector6 mixed_step(const Material& material, VectorX& state, Vector6 strain,
                   const std::array<bool, 3>& held, const Vector3& target, double tolerance);

/// Largest excess over the yield surface that a step of NorSand may leave, divided by the stress
/// scale. The step uses the limit of dilatancy at its start, and a larger image pressure lowers
/// that limit's strength. Other laws have 0.
double excess_of_cone(const Material& material, const VectorX& before, const VectorX& after);

}  // namespace furrow::testing_paths
