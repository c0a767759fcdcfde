// SPDX-License-Identifier: GPL-2.0-or-later
// The undrained clay against closed forms.

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "furrow/material/material.h"
#include "tests/support/paths.h"

namespace furrow::undrained_clay_test {
namespace {

using testing_paths::material_of;
using testing_paths::mixed_step;
using testing_paths::strain_of;
using testing_paths::stretch;

constexpr double su = 3e4, E = 6e6, nu = 0.48;

std::unique_ptr<Material> clay(const std::string& more = "") {
  return material_of(fmt::format(
      "undrained_clay density 1800 su {} {} elasticity linear E {} nu {}", su, more, E, nu));
}

/// Simple shear, gamma per step and steps; returns the stress xz.
double shear(const Material& material, VectorX& state, double gamma, int steps,
             double duration = 0.0) {
  Matrix3 h = Matrix3::Zero();
  h(0, 2) = gamma;
  for (int step = 0; step < steps; ++step) material.update_point(h, state, nullptr, duration);
  return state[field::stress + 5];
}

/// (sigma1 - sigma3)/2 is su in simple shear and plane strain, and sqrt(3)/2 su in the triaxial
/// cell. Pressure changes none of them, and plastic flow keeps the volume.
TEST(UndrainedClay, StrengthsFollowTheirDefinitions) {
  const auto material = clay();
  for (const double pressure_strain : {0.0, 0.002}) {
    VectorX at_rest = material->initial_state();
    material->update_point(stretch(strain_of(-pressure_strain, -pressure_strain, -pressure_strain)),
                           at_rest);
    VectorX state = at_rest;
    EXPECT_NEAR(shear(*material, state, 1e-4, 500) / su, 1.0, 1e-3);
    EXPECT_NEAR(state[field::volume_ratio] / at_rest[field::volume_ratio], 1.0, 1e-12);

    state = at_rest;
    for (int step = 0; step < 500; ++step)
      material->update_point(stretch(strain_of(1e-4, 0, -1e-4)), state);
    EXPECT_NEAR((state[0] - state[2]) / (2 * su), 1.0, 1e-6);
    EXPECT_NEAR(state[field::volume_ratio] / at_rest[field::volume_ratio], 1.0, 1e-12);

    for (const double sign : {-1.0, 1.0}) {
      state = at_rest;
      const double lateral = state[0];
      for (int step = 0; step < 300; ++step)
        mixed_step(*material, state, strain_of(0, 0, sign * 1e-4), {true, true, false},
                   {lateral, lateral, 0}, 1e-6);
      EXPECT_NEAR(sign * (state[2] - state[0]) / (std::sqrt(3.0) * su), 1.0, 1e-6);
    }
  }
}

/// Without rate and sensitivity it is drucker_prager with d = sqrt(3) su, whose footings and walls
/// the study "convergence" compares with closed forms.
TEST(UndrainedClay, PlainClayIsDruckerPrager) {
  const auto plain = clay(),
             ideal = material_of(
                 fmt::format("drucker_prager density 1800 d {} beta 0 elasticity linear E {} nu {}",
                             std::sqrt(3.0) * su, E, nu));
  VectorX a = plain->initial_state(), b = ideal->initial_state();
  for (int step = 0; step < 200; ++step) {
    const double x = std::sin(0.7 * step), y = std::cos(0.3 * step);
    const Matrix3 h = 4e-3 * (Matrix3() << x, y, -x, 0.5, -y, x * y, y, -0.2, 0.3 * x).finished();
    plain->update_point(h, a);
    ideal->update_point(h, b);
    ASSERT_LT((stress_of(a) - stress_of(b)).norm(), 1e-9 * su) << step;
  }
  EXPECT_GT(a[field::dissipated_energy], 0.0);
  EXPECT_NEAR(a[field::dissipated_energy] / b[field::dissipated_energy], 1.0, 1e-9);
}

/// Ten times the rate above the reference adds the share; below it the rate does not matter.
TEST(UndrainedClay, StrengthGrowsPerDecadeOfRate) {
  const auto material = clay("rate_share 0.12 reference_rate 0.01");
  const auto strength = [&](double rate) {
    VectorX state = material->initial_state();
    return shear(*material, state, 1e-4, 1500, 1e-4 / rate) / su;
  };
  EXPECT_NEAR(strength(1e-4), 1.0, 1e-3);
  EXPECT_NEAR(strength(1e-2), 1.0, 1e-3);
  EXPECT_NEAR(strength(1e-1) - strength(1e-2), 0.12, 1e-3);
  EXPECT_NEAR(strength(1e1) - strength(1e-2), 0.36, 1e-3);
}

/// The strength falls with the slip to su over the sensitivity, for any width of the band. The heat
/// of an area of the band is the integral of the strength over the slip.
TEST(UndrainedClay, RemouldingFollowsTheSlipAcrossTheBand) {
  const double sensitivity = 4.0, slip_95 = 0.05;
  const auto fall = [&](double slip) {
    return 1 / sensitivity + (1 - 1 / sensitivity) * std::exp(-3 * slip / slip_95);
  };
  for (const double width : {0.005, 0.02, 0.08}) {
    const auto material =
        clay(fmt::format("sensitivity {} slip_95 {} band_width {}", sensitivity, slip_95, width));
    VectorX state = material->initial_state();
    const double dslip = 2e-6;
    for (const int steps : {5000, 20000, 100000}) {
      const double tau = shear(*material, state, dslip / width, steps);
      const double slip = std::sqrt(3.0) * state[field::internal] * width;
      EXPECT_NEAR(tau / (su * fall(slip)), 1.0, 2e-3) << width;
      const double work = su * (slip / sensitivity + (1 - 1 / sensitivity) * slip_95 / 3 *
                                                         (1 - std::exp(-3 * slip / slip_95)));
      EXPECT_NEAR(state[field::dissipated_energy] * width / work, 1.0, 2e-3) << width;
    }
    EXPECT_NEAR(state[field::stress + 5] * sensitivity / su, 1.0, 2e-3) << width;
  }
}

}  // namespace
}  // namespace furrow::undrained_clay_test
