// SPDX-License-Identifier: GPL-2.0-or-later
// Hard points of the cohesive Cam clay, one by one; random_paths_test.cpp mixes them.

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "furrow/material/models/cohesive_cam_clay/cohesive_cam_clay.h"
#include "sound_steps.h"
#include "tests/support/error_of.h"

namespace furrow::cam_clay_hard_points_test {
namespace {

using testing_paths::expect_sound_step;
using testing_paths::jumps_of_one_half;
using testing_paths::material_of;
using testing_paths::small_then_large;
using testing_paths::strain_of;
using testing_paths::stretch;

constexpr double bulk = 13.79e6 / 1.2;

std::string snow(const std::string& more, const std::string& interpolation = "linear",
                 const std::string& rules = "beyond extrapolate") {
  return "cohesive_cam_clay density 90 elasticity linear E 13.79e6 nu 0.3 "
         "hardening table p 113.76 2e4 4e5 2.4e7 eps_vol_pl 0 0.593 1.083 2.4 interpolation " +
         interpolation + " " + rules + " " + more;
}

double eps_of(const VectorX& state) { return state[CohesiveCamClay::eps_vol_pl]; }

/// Takes the steps; after each the elastic law holds between pressure and elastic strain, too.
Branch expect_sound_steps(const Material& material, VectorX& state,
                          const std::vector<Vector6>& strains) {
  Branch branch{};
  for (const Vector6& strain : strains) {
    const double elastic_strain = invariants(stress_of(state)).p / bulk + eps_of(state);
    branch = expect_sound_step(material, state, strain, 60);
    EXPECT_NEAR(invariants(stress_of(state)).p / bulk + eps_of(state),
                elastic_strain - strain.head<3>().sum(), 1e-10 * strain.norm() + 1e-15)
        << "after strain " << strain.transpose();
  }
  return branch;
}

const std::vector<std::string> shapes = {"M 3.3 tension_ratio 0.1", "M 3.3 tension_ratio 0",
                                         "M 1.2 tension_ratio 1", "M 0.05 tension_ratio 0.3",
                                         "M 20 tension_ratio 1e-4"};

TEST(CamClayHardPoints, NearlyZeroStrengthIsSolved) {
  for (const std::string& shape : shapes) {
    const auto material = material_of(snow(shape));
    VectorX state = material->initial_state();
    expect_sound_steps(*material, state, small_then_large());
  }
}

TEST(CamClayHardPoints, StrainStepsOfOneHalfAreSolved) {
  for (const std::string& shape : shapes) {
    const auto material = material_of(snow(shape));
    for (const std::vector<Vector6>& path : jumps_of_one_half()) {
      VectorX state = material->initial_state();
      expect_sound_steps(*material, state, path);
    }
  }
}

/// Sheared at constant volume from the centre of the ellipse, where the trial pressure is c exactly
/// and flow neither compacts nor loosens.
TEST(CamClayHardPoints, ShearAtTheCriticalStateIsSolved) {
  for (const std::string& shape : shapes) {
    const auto material = material_of(snow(shape + " eps_vol_pl_0 0.6"));
    const auto& clay = static_cast<const CohesiveCamClay&>(*material);
    const double centre = clay.parameters().centre * clay.p0(0.6);
    for (const double jump : {1e-4, 1e-2, 0.5}) {
      VectorX state = material->initial_state();
      state.segment<3>(field::stress).setConstant(-centre);
      expect_sound_steps(*material, state, {strain_of(0, 0, 0, jump), strain_of(0, 0, 0, jump)});
      const Invariants end = invariants(stress_of(state));
      EXPECT_NEAR(end.p, centre, 1e-9 * centre + 1e-9);
      EXPECT_NEAR(eps_of(state), 0.6, 1e-12);
    }
  }
}

TEST(CamClayHardPoints, CompactionToATenthOfTheVolumeIsSolved) {
  for (const std::string interpolation : {"linear", "log"}) {
    for (const std::string& shape : shapes) {
      const auto material = material_of(snow(shape, interpolation));
      VectorX state = material->initial_state();
      UpdateReport report;
      for (int step = 0; step < 230; ++step)
        report += material->update_point(stretch(strain_of(0, 0, -0.01)), state);
      EXPECT_NEAR(material->current_density(state), 90 * std::exp(2.3), 1e-9);
      EXPECT_LE(material->yield_function(state), 1e-8 * material->stress_scale(state));
      EXPECT_EQ(report.beyond_ice, 0u);  // 898 kg/m3
      expect_sound_steps(*material, state, {strain_of(0.01, 0, 0.05), strain_of(0, 0, -0.5)});
    }
  }
}

/// Torn to three times its volume snow has no strength left, but some; pressed together again it
/// bears nothing until it is as dense as it was, and then what it bore there.
TEST(CamClayHardPoints, RecompressionAfterTensileFailureIsSolved) {
  for (const std::string& shape : shapes) {
    const auto material = material_of(snow(shape));
    VectorX straight = material->initial_state(), torn = straight;
    for (int step = 0; step < 110; ++step)
      expect_sound_steps(*material, torn, {strain_of(0.01 / 3, 0.01 / 3, 0.01 / 3)});
    const auto& clay = static_cast<const CohesiveCamClay&>(*material);
    EXPECT_GT(clay.p0(eps_of(torn)), 0.0);
    EXPECT_LT(clay.p0(eps_of(torn)), 1e-20);
    for (int step = 0; step < 110; ++step)
      expect_sound_steps(*material, torn, {strain_of(-0.01 / 3, -0.01 / 3, -0.01 / 3)});
    for (VectorX* state : {&straight, &torn})
      for (int step = 0; step < 50; ++step)
        expect_sound_steps(*material, *state, {strain_of(-0.01 / 3, -0.01 / 3, -0.01 / 3)});
    EXPECT_NEAR(torn[0] / straight[0], 1.0, 1e-10);
    EXPECT_NEAR(eps_of(torn), eps_of(straight), 1e-13);
  }
}

/// Unloading and reloading is elastic and comes back to where it left.
TEST(CamClayHardPoints, UnloadingAndReloadingAreElastic) {
  for (const std::string& shape : {shapes[0], shapes[1]}) {
    const auto material = material_of(snow(shape));
    VectorX state = material->initial_state();
    for (int step = 0; step < 700; ++step) {
      expect_sound_steps(*material, state, {strain_of(0, 0, -1e-3)});
      if (step % 100 != 50) continue;
      const Vector6 before = stress_of(state), unload = strain_of(0, 0, 2e-6);
      for (int k = 0; k < 20; ++k)
        EXPECT_EQ(expect_sound_steps(*material, state, {unload}), Branch::elastic);
      for (int k = 0; k < 20; ++k) expect_sound_steps(*material, state, {Vector6(-unload)});
      EXPECT_LT((stress_of(state) - before).norm(), 1e-9 * before.norm());
    }
  }
}

TEST(CamClayHardPoints, TableExtrapolatesWithANoteOrStops) {
  const std::string shape = shapes[0] + " eps_vol_pl_0 0.1";
  for (const double direction : {-1.0, 1.0}) {
    const Vector6 strain = strain_of(1, 1, 1) * (0.1 * direction);
    const auto going = material_of(snow(shape));
    VectorX state = going->initial_state();
    UpdateReport report;
    for (int step = 0; step < 20; ++step) report += going->update_point(stretch(strain), state);
    EXPECT_GT(direction < 0 ? report.beyond_data : report.below_data, 0u);
    EXPECT_EQ(direction < 0 ? report.below_data : report.beyond_data, 0u);
    const auto stopping = material_of(snow(shape, "linear", "beyond stop below stop"));
    state = stopping->initial_state();
    EXPECT_THAT(test::error_of<StateError>([&] {
                  for (int step = 0; step < 20; ++step)
                    stopping->update_point(stretch(strain), state);
                }),
                ::testing::HasSubstr("the hardening table ends"));
  }
}

}  // namespace
}  // namespace furrow::cam_clay_hard_points_test
