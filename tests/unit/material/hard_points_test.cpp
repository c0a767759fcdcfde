// SPDX-License-Identifier: GPL-2.0-or-later
// Hard points of the cap law, one by one; random_paths_test.cpp mixes them.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "furrow/material/models/drucker_prager_cap/drucker_prager_cap.h"
#include "sound_steps.h"
#include "tests/support/error_of.h"

namespace furrow::hard_points_test {
namespace {

using testing_paths::expect_sound_step;
using testing_paths::jumps_of_one_half;
using testing_paths::material_of;
using testing_paths::small_then_large;
using testing_paths::strain_of;
using testing_paths::stretch;

std::string snow(const std::string& more, const std::string& interpolation = "linear",
                 const std::string& beyond = "extrapolate") {
  return "drucker_prager_cap density 200 elasticity linear E 13.79e6 nu 0.3 "
         "hardening table p 113.76 5e4 1e5 2e5 5e5 1e6 2e6 2.8e6 3.25e6 6e6 6e7 "
         "eps_vol_pl 0 0.593 0.669 0.806 0.944 1.083 1.299 1.455 1.475 1.50 1.514 interpolation " +
         interpolation + " beyond " + beyond + " beta 22.53 " + more;
}

Branch expect_sound_steps(const Material& material, VectorX& state,
                          const std::vector<Vector6>& strains) {
  Branch branch{};
  for (const Vector6& strain : strains) branch = expect_sound_step(material, state, strain, 200);
  return branch;
}

double eps_of(const VectorX& state) { return state[DruckerPragerCap::eps_vol_pl]; }

/// E/pb = 1e5, cohesion next to nothing or nothing.
TEST(HardPoints, NearlyZeroStrengthIsSolved) {
  for (const std::string d : {"0", "1e-3", "1"}) {
    const auto material = material_of(snow("R 0.02 d " + d));
    VectorX state = material->initial_state();
    expect_sound_steps(*material, state, small_then_large());
  }
}

TEST(HardPoints, SmallCapEccentricityIsSolved) {
  for (const std::string more : {"R 1e-4 d 5e3", "R 1e-4 d 5e3 alpha 0.05", "R 1e-4 d 5e3 K 0.778",
                                 "R 1e-4 d 5e3 K 0.6 section matsuoka_nakai"}) {
    const auto material = material_of(snow(more));
    VectorX state = material->initial_state();
    for (int step = 0; step < 200; ++step)
      expect_sound_steps(*material, state, {strain_of(0, 0, -5e-3)});
    EXPECT_NEAR(eps_of(state), 1.0, 0.15);
    expect_sound_steps(
        *material, state,
        {strain_of(0, 0, 1e-3), strain_of(0, 0, -2e-3), strain_of(-1e-2, -1e-2, 0, 0.02)});
  }
}

/// The corner between cap and shear line (alpha 0) and the transition (alpha 0.05): sheared at
/// constant volume the state ends at pa.
TEST(HardPoints, CapCornerAndTransitionAreSolved) {
  for (const std::string alpha : {"0", "0.05"}) {
    const auto material = material_of(snow("R 0.1 d 5e3 eps_vol_pl_0 0.7 alpha " + alpha));
    const auto& cap = static_cast<const DruckerPragerCap&>(*material);
    const double tan_beta = std::tan(radians(22.53)), A = cap.parameters().A;
    for (const double p0 : {2e4, 6e4, 1.1e5}) {  // left of the corner, near it, on the cap
      VectorX state = material->initial_state();
      state.segment<3>(field::stress).setConstant(-p0);
      for (int step = 0; step < 4000; ++step)
        expect_sound_steps(*material, state, {strain_of(0, 0, 0, 2e-4)});
      const Invariants end = invariants(stress_of(state));
      const double pa = cap.pa(eps_of(state));
      EXPECT_NEAR(end.p / pa, 1.0, 1e-3) << "p0 " << p0 << " alpha " << alpha;
      EXPECT_NEAR(end.q / (A * (5e3 + pa * tan_beta)), 1.0, 1e-4)
          << "p0 " << p0 << " alpha " << alpha;
    }
  }
}

TEST(HardPoints, ApexInTensionIsSolved) {
  const double apex = 5e3 / std::tan(radians(22.53));
  const auto material = material_of(snow("R 0.02 d 5e3 eps_vol_pl_0 0.6"));
  VectorX state = material->initial_state();
  EXPECT_EQ(expect_sound_steps(*material, state, {strain_of(0.01, 0.01, 0.01)}), Branch::tension);
  EXPECT_NEAR(invariants(stress_of(state)).p, -apex, 1e-9 * apex);
  EXPECT_NEAR(invariants(stress_of(state)).q, 0.0, 1e-9 * apex);
  expect_sound_steps(
      *material, state,
      {strain_of(0.1, 0.05, 0.2, 0.1), strain_of(0, 0, 0, 0.5), strain_of(-0.2, -0.1, -0.3)});
}

TEST(HardPoints, TensionCutOffIsSolved) {
  const auto material = material_of(snow("R 0.02 d 5e3 eps_vol_pl_0 0.6 tension 1e3"));
  VectorX state = material->initial_state();
  EXPECT_EQ(expect_sound_steps(*material, state, {strain_of(2e-3, 2e-3, 2e-3)}), Branch::tension);
  EXPECT_NEAR(invariants(stress_of(state)).p, -1e3, 1e-6);
  // Sheared at the cut-off: t stays on the shear line at p = -1 kPa.
  EXPECT_EQ(expect_sound_steps(*material, state, {strain_of(0.02, 0.02, 0.02, 1e-3)}),
            Branch::tension);
  EXPECT_NEAR(invariants(stress_of(state)).p, -1e3, 1e-6);
  EXPECT_NEAR(invariants(stress_of(state)).q, 5e3 - 1e3 * std::tan(radians(22.53)), 1e-6);
}

TEST(HardPoints, CompactionToATenthOfTheVolumeIsSolved) {
  for (const std::string interpolation : {"linear", "log"}) {
    const auto material = material_of(
        "drucker_prager_cap density 90 d 5e3 beta 22.53 R 0.02 elasticity linear E 13.79e6 nu 0.3 "
        "hardening table "
        "p 113.76 5e4 1e6 6e7 eps_vol_pl 0 0.593 1.083 2.4 beyond extrapolate interpolation " +
        interpolation);
    VectorX state = material->initial_state();
    UpdateReport report;
    for (int step = 0; step < 230; ++step)
      report += material->update_point(stretch(strain_of(0, 0, -0.01)), state);
    EXPECT_NEAR(state[field::volume_ratio], std::exp(-2.3), 1e-12);
    EXPECT_NEAR(material->current_density(state), 90 * std::exp(2.3), 1e-9);
    EXPECT_LE(material->yield_function(state), 1e-8 * material->stress_scale(state));
    EXPECT_EQ(report.beyond_ice, 0u);  // 898 kg/m3
    material->update_point(stretch(strain_of(0, 0, -0.03)), state);
  }
}

/// Unloading and reloading is elastic and comes back to where it left; further loading goes on as
/// if it had not happened.
TEST(HardPoints, UnloadingAndReloadingAreElastic) {
  const auto material = material_of(snow("R 0.02 d 5e3"));
  VectorX straight = material->initial_state(), cycled = straight;
  const Vector6 load = strain_of(0, 0, -1e-3), unload = strain_of(0, 0, 2e-6);
  for (int step = 0; step < 700; ++step) material->update_point(stretch(load), straight);
  for (int step = 0; step < 700; ++step) {
    expect_sound_steps(*material, cycled, {load});
    if (step % 100 != 50) continue;
    const Vector6 before = stress_of(cycled);
    for (int k = 0; k < 50; ++k)
      EXPECT_EQ(expect_sound_steps(*material, cycled, {unload}), Branch::elastic);
    for (int k = 0; k < 50; ++k) expect_sound_steps(*material, cycled, {Vector6(-unload)});
    EXPECT_LT((stress_of(cycled) - before).norm(), 1e-9 * before.norm());
  }
  EXPECT_LT((stress_of(cycled) - stress_of(straight)).norm(), 1e-8 * stress_of(straight).norm());
}

TEST(HardPoints, StrainStepsOfOneHalfAreSolved) {
  for (const std::string more :
       {"R 0.02 d 5e3", "R 1e-4 d 0", "R 1 d 1e5 alpha 0.05", "R 0.02 d 5e3 K 0.8 tension 0",
        "R 0.02 d 5e3 K 0.6 section matsuoka_nakai", "R 0.02 d 0 K 0.778"}) {
    const auto material = material_of(snow(more));
    for (const std::vector<Vector6>& path : jumps_of_one_half()) {
      VectorX state = material->initial_state();
      expect_sound_steps(*material, state, path);
    }
  }
}

/// Hydrostatic compression lands on the hardening curve whatever it is made of, in one step or in
/// many.
TEST(HardPoints, HydrostaticCurveIsTheHardeningLaw) {
  const auto linear = material_of(snow("R 0.02 d 5e3")),
             logarithmic = material_of(snow("R 0.02 d 5e3", "log"));
  const auto exponential = material_of(
      "drucker_prager_cap density 200 d 5e3 beta 22.53 R 0.02 elasticity linear E 13.79e6 nu 0.3 "
      "hardening exponential pc0 113.76 lambda 0.35 kappa 0.005 e0 3.5");
  for (const auto* material : {&linear, &logarithmic, &exponential}) {
    VectorX state = (*material)->initial_state();
    for (const double step : {0.01, 0.1, 0.25, 0.3, 0.2}) {
      expect_sound_steps(**material, state, {strain_of(-step / 3, -step / 3, -step / 3)});
      const double eps = eps_of(state), J = std::exp(-eps);
      double strength = 0;
      if (material == &linear) strength = eps < 0.593 ? 113.76 + (5e4 - 113.76) * eps / 0.593 : 0;
      if (material == &logarithmic)
        strength = eps < 0.593 ? 113.76 * std::pow(5e4 / 113.76, eps / 0.593) : 0;
      if (material == &exponential)
        strength = 113.76 * std::exp(4.5 * (1 - J) / (0.35 - 0.005 * J));
      if (strength > 0) {
        EXPECT_NEAR(invariants(stress_of(state)).p / strength, 1.0, 1e-11);
      }
    }
  }
}

/// Strengths by density are one curve: from every initial density compression ends on it.
TEST(HardPoints, StrengthsByDensityHoldForEveryInitialDensity) {
  for (const double density : {110.0, 160.0, 220.0}) {
    const auto material = material_of(
        fmt::format("drucker_prager_cap density {} d 0 beta 65 R 0.02 elasticity linear E 13.79e6 "
                    "nu 0.3 hardening by_density p 100 1e4 1e5 rho 100 300 500 interpolation log "
                    "beyond stop",
                    density));
    VectorX state = material->initial_state();
    for (double rho = density; rho < 380.0;) {
      expect_sound_steps(*material, state, {strain_of(-0.1, -0.1, -0.1)});
      rho = density * std::exp(eps_of(state));  // without its elastic part
      const double strength = rho < 300.0
                                  ? 100.0 * std::pow(100.0, std::log(rho / 100) / std::log(3.0))
                                  : 1e4 * std::pow(10.0, std::log(rho / 300) / std::log(5.0 / 3));
      EXPECT_NEAR(invariants(stress_of(state)).p / strength, 1.0, 1e-10) << density;
    }
  }
}

TEST(HardPoints, TableExtrapolatesWithANoteOrStops) {
  const auto going = material_of(snow("R 0.02 d 5e3"));
  const auto stopping = material_of(snow("R 0.02 d 5e3", "linear", "stop"));
  VectorX first = going->initial_state(), second = first;
  UpdateReport report;
  for (int step = 0; step < 14; ++step)
    report += going->update_point(stretch(strain_of(0, 0, -0.1)), first);
  EXPECT_EQ(report.beyond_data, 0u);
  for (int step = 0; step < 14; ++step)
    stopping->update_point(stretch(strain_of(0, 0, -0.1)), second);
  EXPECT_EQ(first, second);
  report = UpdateReport();
  for (int step = 0; step < 20; ++step)
    report += going->update_point(stretch(strain_of(0, 0, -0.5)), first);
  EXPECT_GT(report.beyond_data, 0u);
  EXPECT_GT(report.beyond_ice, 0u);
  EXPECT_THAT(
      test::error_of<StateError>([&] {
        for (int step = 0; step < 20; ++step)
          stopping->update_point(stretch(strain_of(0, 0, -0.5)), second);
      }),
      ::testing::HasSubstr("the hardening table ends (its rule beyond the table is 'stop')"));
}

/// Where (16) loosens faster than friction, plastic work is negative; frozen energy pays for it,
/// and heat is never negative.
TEST(HardPoints, SofteningReleasesFrozenEnergy) {
  const auto material = material_of(snow("R 0.02 d 0 eps_vol_pl_0 0.7"));
  VectorX state = material->initial_state();
  state.segment<3>(field::stress).setConstant(-5e3);  // p far below pa/2
  expect_sound_steps(*material, state, {strain_of(0, 0, 0, 2e-3)});
  for (int step = 0; step < 20; ++step) {
    const VectorX before = state;
    EXPECT_EQ(expect_sound_steps(*material, state, {strain_of(3e-5, 3e-5, 3e-5, 2e-4)}),
              Branch::shear);
    const double frozen = state[field::frozen_energy] - before[field::frozen_energy];
    const double heat = state[field::dissipated_energy] - before[field::dissipated_energy];
    EXPECT_LT(frozen, 0.0);
    EXPECT_GT(heat, 0.0);
    if (step == 0) {
      EXPECT_LT(frozen + heat, 0.0) << "plastic work";
    }
  }
}

}  // namespace
}  // namespace furrow::hard_points_test
