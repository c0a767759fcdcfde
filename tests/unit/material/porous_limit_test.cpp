// SPDX-License-Identifier: GPL-2.0-or-later
// Porous elasticity where rounding leaves nothing of p + p_t: a law goes on from there.

#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/paths.h"

namespace furrow::porous_limit_test {
namespace {

using testing_paths::material_of;
using testing_paths::stretch;

constexpr double kappa = 0.005, e0 = 3.5, stiffness = (1 + e0) / kappa;

std::string elastic_ground(double p0, double limit, const std::string& shear) {
  return fmt::format("elastic density 200 elasticity porous kappa {} e0 {} p0 {} pt_el {} {}",
                     kappa, e0, p0, limit, shear);
}

Vector6 volumetric(double strain) {
  Vector6 result = Vector6::Zero();
  result.head<3>().setConstant(strain / 3);
  return result;
}

/// From J_el = 1 + 36 kappa/(1 + e0), where (p + p_t)/(p0 + p_t) = 2^-52, the strain ln J_el leads
/// back to p0; rounding of the stress at the limit is a few times as large.
TEST(PorousLimit, StretchBeyondTheTensileLimitRecompressesFromThere) {
  const double back = std::log1p(std::log(0x1p52) / stiffness);
  for (const double p0 : {0.0, 100.0}) {
    for (int i = 0; i < 100; ++i) {
      const double limit = std::pow(1.1, i);
      const auto material = material_of(elastic_ground(p0, limit, "nu 0.3"));
      VectorX state = material->initial_state();
      for (int step = 0; step < 10; ++step) {
        ASSERT_NO_THROW(material->update_point(stretch(volumetric(0.05)), state)) << limit;
        EXPECT_TRUE(std::isfinite(material->wave_speed(state))) << limit;
      }
      EXPECT_NEAR(invariants(stress_of(state)).p, -limit, 1e-14 * limit);
      material->update_point(stretch(volumetric(-back)), state);
      const double ratio = (invariants(stress_of(state)).p + limit) / (p0 + limit);
      EXPECT_GT(ratio, 1 - 1e-10) << limit;
      EXPECT_LT(ratio, 8.0) << limit;
    }
  }
}

/// A deviator leaves its own rounding in p, which may be far larger than p + p_t, and negative.
TEST(PorousLimit, ShearAtTheTensileLimitStaysFinite) {
  for (const std::string shear : {"nu 0.3", "G 1e5"}) {
    for (const double p0 : {0.0, 100.0}) {
      for (int i = p0 > 0 ? -1 : 0; i < 100; ++i) {
        const double limit = i < 0 ? 0.0 : std::pow(1.1, i);
        const auto material = material_of(elastic_ground(p0, limit, shear));
        VectorX state = material->initial_state();
        for (int step = 0; step < 60; ++step) {
          Vector6 strain = volumetric(step < 40 ? 0.015 : -0.015);
          strain[0] += 3e-4 * (step % 5 - 2);
          strain[3] = 0.01 * (step % 3 - 1);
          ASSERT_NO_THROW(material->update_point(stretch(strain), state))
              << shear << " p0 " << p0 << " pt_el " << limit << " step " << step;
          ASSERT_TRUE(std::isfinite(material->wave_speed(state)))
              << shear << " p0 " << p0 << " pt_el " << limit << " step " << step;
        }
        EXPECT_GT(invariants(stress_of(state)).p, -limit);
      }
    }
  }
}

/// Foam so dense, pc = 2e14 Pa, that its tensile strength pt = 0.2 Pa is rounding beside pc:
/// stretched, it is elastic down to the limit of elasticity, which this state stands on.
TEST(PorousLimit, TensileStrengthBelowRoundingIsSolved) {
  const auto material = material_of(
      "crushable_foam density 300 pt 0.21402211384803016 sigma0 215.801025589315 "
      "K 0.9531502684753514 elasticity porous elasticity.kappa 0.001260253455597796 "
      "elasticity.e0 4.934272470501333 elasticity.p0 0 pt_el 1.6359545910582647 "
      "nu 0.4127238901437383 hardening exponential pc0 1084.725842591627 "
      "lambda 0.13085832659932883 hardening.kappa 0.018262138988287328 "
      "hardening.e0 3.145567415808987");
  const double limit = 1.6359545910582647;
  VectorX state = material->initial_state();
  state.segment<3>(field::stress).setConstant(limit);
  state[field::volume_ratio] = 0.3203623667258933;
  state[field::internal] = 1.5882523099359593;
  ASSERT_EQ(invariants(stress_of(state)).p + limit, 0.0);
  Matrix3 turn_and_stretch;
  turn_and_stretch << -8.96154e-07, 0.00413632, -0.00156349, -0.00416137, -2.84451e-05, -0.00579482,
      0.00153144, 0.00580271, -1.84139e-05;
  ASSERT_NO_THROW(material->update_point(turn_and_stretch, state));
  EXPECT_NEAR(invariants(stress_of(state)).p, -limit, 1e-14 * limit);
  ASSERT_NO_THROW(material->update_point(stretch(volumetric(-0.05)), state));
  EXPECT_GT(invariants(stress_of(state)).p, 0.0);
}

/// From a tensile strength just above the limit to the cap in one step: p and the plastic strain of
/// its end fulfil the elastic law, however close to the limit the step begins.
TEST(PorousLimit, OneStepFromTheTensileLimitToTheCapIsSolved) {
  const double apex = 5e3 / std::tan(radians(22.53));
  for (const double gap : {1e-2, 1e-4, 1e-5, 1e-6, 1e-9}) {
    for (const double jump : {0.1, 0.3}) {
      for (const std::string K : {"1", "0.8"}) {
        const double limit = apex * (1 + gap);
        const auto material = material_of(fmt::format(
            "drucker_prager_cap density 200 d 5e3 beta 22.53 R 0.02 K {} eps_vol_pl_0 0.6 "
            "elasticity porous kappa {} e0 {} pt_el {} nu 0.3 hardening table p 113.76 5e4 1e6 6e7 "
            "eps_vol_pl 0 0.593 1.083 1.514 interpolation linear beyond extrapolate",
            K, kappa, e0, limit));
        VectorX state = material->initial_state();
        material->update_point(stretch(volumetric(0.15)), state);
        const double p_start = invariants(stress_of(state)).p, start = state[field::internal];
        EXPECT_NEAR(p_start, -apex, 1e-9 * apex);
        Vector6 strain = Vector6::Zero();
        strain[2] = -jump;
        Branch branch{};
        material->update_point(stretch(strain), state, &branch);
        EXPECT_EQ(branch, Branch::cap);
        const double ratio = (1 - std::log((p_start + limit) / limit) / stiffness) *
                             std::exp(state[field::internal] - start - jump);
        const double expected = limit * std::expm1(stiffness * (1 - ratio));
        const double rounding = std::numeric_limits<double>::epsilon() / gap;  // of p + p_t
        EXPECT_NEAR(invariants(stress_of(state)).p / expected, 1.0, 1e-11 + 4 * rounding)
            << "gap " << gap << " jump " << jump << " K " << K;
      }
    }
  }
}

}  // namespace
}  // namespace furrow::porous_limit_test
