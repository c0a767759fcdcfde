// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Requirements on every step of a yielding law, and paths that are hard for all of them.

#include <vector>

#include <gtest/gtest.h>

#include "tests/support/paths.h"

namespace furrow::testing_paths {

/// Takes the step; after it the state is finite, on or inside its surface, and no heat is negative.
inline Branch expect_sound_step(const Material& material, VectorX& state, const Vector6& strain,
                                unsigned maximum_iterations) {
  Branch branch{};
  const double heat = state[field::dissipated_energy];
  const UpdateReport report = material.update_point(stretch(strain), state, &branch);
  EXPECT_TRUE(state.allFinite());
  EXPECT_LE(material.yield_function(state), 1e-8 * material.stress_scale(state))
      << "after strain " << strain.transpose();
  EXPECT_GE(state[field::dissipated_energy] - heat, -1e-14 * material.stress_scale(state))
      << "after strain " << strain.transpose();
  EXPECT_LT(report.max_iterations, maximum_iterations);
  return branch;
}

/// From nearly zero strength.
inline std::vector<Vector6> small_then_large() {
  return {strain_of(0, 0, -1e-5),      strain_of(0, 0, -1e-2),     strain_of(1e-3, 0, 0, 0.01),
          strain_of(0.01, 0.01, 0.01), strain_of(0, 0, -0.2),      strain_of(0, 0, 0, 0.1),
          strain_of(0.3, 0.3, 0.3),    strain_of(-0.3, -0.3, -0.3)};
}

/// Steps of one half, with every kind of first step.
inline std::vector<std::vector<Vector6>> jumps_of_one_half() {
  const double jump = 0.5;
  std::vector<std::vector<Vector6>> paths;
  for (const Vector6& first :
       {strain_of(-jump, 0, 0), strain_of(-jump, -jump, -jump), strain_of(jump, jump, jump),
        strain_of(0, 0, 0, jump), strain_of(jump, -jump, 0), strain_of(0, 0, jump)})
    paths.push_back({first, strain_of(0, -jump, 0), strain_of(jump, 0, -jump, jump),
                     strain_of(jump, jump, jump), strain_of(-jump, -jump, -jump)});
  return paths;
}

}  // namespace furrow::testing_paths
