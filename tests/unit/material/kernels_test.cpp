// SPDX-License-Identifier: GPL-2.0-or-later
// The kernels of every instruction set that this processor runs give the same results, and the
// finite-strain kinematics agree with eigenvalues.

#include <random>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <gtest/gtest.h>

#include "furrow/material/models/cohesive_cam_clay/cohesive_cam_clay.h"
#include "furrow/material/models/cohesive_cap/cohesive_cap.h"
#include "furrow/material/models/crushable_foam/crushable_foam.h"
#include "furrow/material/models/drucker_prager/drucker_prager.h"
#include "furrow/material/models/drucker_prager_cap/drucker_prager_cap.h"
#include "furrow/material/models/neo_hookean/neo_hookean_parameters.h"
#include "furrow/material/models/norsand/norsand.h"
#include "furrow/material/models/undrained_clay/undrained_clay.h"
#include "furrow/simd/dispatch.h"
#include "tests/support/paths.h"

namespace furrow::kernels_test {
namespace {

using testing_paths::material_of;

TEST(Kernels, KernelTablesHaveTheirInstructionSet) {
  const std::vector<InstructionSet> sets = available_instruction_sets();
  ASSERT_FALSE(sets.empty());
  EXPECT_EQ(sets.front(), InstructionSet::baseline);
  for (const InstructionSet set : sets) {
    EXPECT_EQ(kernels_for<DruckerPragerCapKernels>(set).instruction_set, set);
    EXPECT_EQ(kernels_for<CohesiveCamClayKernels>(set).instruction_set, set);
    EXPECT_EQ(kernels_for<CohesiveCapKernels>(set).instruction_set, set);
    EXPECT_EQ(kernels_for<NorSandKernels>(set).instruction_set, set);
    EXPECT_EQ(kernels_for<NeoHookeanKernels>(set).instruction_set, set);
  }
  EXPECT_EQ(kernels<NeoHookeanKernels>().instruction_set, chosen_instruction_set());
}

/// The same steps of 1003 points by the kernels of every instruction set.
template <class Law, class Kernels>
void expect_instruction_sets_to_agree(const std::string& text) {
  const auto material = material_of(text);
  const auto& law = static_cast<const Law&>(*material);
  constexpr std::size_t n = 1003;
  const std::size_t fields = material->state_fields().size();
  std::vector<std::vector<std::vector<double>>> results;
  for (const InstructionSet set : available_instruction_sets()) {
    const auto& kernels = kernels_for<Kernels>(set);
    std::mt19937 engine(3);
    std::normal_distribution<double> normal;
    std::vector<std::vector<double>> state(fields, std::vector<double>(n)),
        gradient(9, std::vector<double>(n));
    std::vector<double*> pointers;
    for (std::size_t f = 0; f < fields; ++f) {
      std::fill(state[f].begin(), state[f].end(), material->state_fields()[f].initial);
      pointers.push_back(state[f].data());
    }
    PointBlock block;
    block.size = n;
    block.state = pointers.data();
    for (std::size_t k = 0; k < 9; ++k) block.gradient[k] = gradient[k].data();
    for (int step = 0; step < 8; ++step) {
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < 9; ++k)
          gradient[k][i] = (i % 7 == 0 ? 3e-2 : 1e-3) * (normal(engine) - (k % 4 == 0 ? 0.5 : 0.0));
      EXPECT_EQ(kernels.update(law.parameters(), 200, block).failure, Failure::none)
          << to_string(set);
    }
    results.push_back(state);
  }
  for (const auto& result : results)
    for (std::size_t f = 0; f < fields; ++f)
      for (std::size_t i = 0; i < n; ++i)
        ASSERT_NEAR(result[f][i], results[0][f][i],
                    1e-7 * (f < 6 ? 1e5 : 1 + std::abs(results[0][f][i])))
            << text << ": " << material->state_fields()[f].name;
}

TEST(Kernels, ResultsOfInstructionSetsAgree) {
  const std::string snow =
      " elasticity linear E 13.79e6 nu 0.3 hardening table p 113.76 5e4 1e6 6e7 eps_vol_pl 0 0.593 "
      "1.083 1.514 beyond extrapolate interpolation ";
  const std::string cap = "drucker_prager_cap density 200 d 5e3 beta 22.53 R 0.05 eps_vol_pl_0 0.3",
                    clay = "cohesive_cam_clay density 200 M 3.3 tension_ratio 0.1 eps_vol_pl_0 0.3";
  for (const std::string more :
       {"linear", "log alpha 0.05", "linear K 0.8", "linear K 0.65 section matsuoka_nakai"})
    expect_instruction_sets_to_agree<DruckerPragerCap, DruckerPragerCapKernels>(cap + snow + more);
  for (const std::string more : {"linear", "log"})
    expect_instruction_sets_to_agree<CohesiveCamClay, CohesiveCamClayKernels>(clay + snow + more);
  for (const std::string more : {"linear", "log"})
    expect_instruction_sets_to_agree<CohesiveCap, CohesiveCapKernels>(
        "cohesive_cap density 200 nu_p 0.1 d 2e3 d_density 200 d_exponent 3 beta 30 "
        "tension_ratio 0.2 eps_vol_pl_0 0.3" +
        snow + more);
  for (const std::string more : {"N 0.5", "N 0.3 K 0.8", "N 0.6 K 0.7 section matsuoka_nakai"})
    expect_instruction_sets_to_agree<NorSand, NorSandKernels>(
        "norsand density 1600 e0 0.7 M 1.2 gamma 0.8 lambda 0.02 chi 3.5 H 100 G 4e7 n 0.45 nu "
        "0.2 " +
        more);
  expect_instruction_sets_to_agree<DruckerPrager, DruckerPragerKernels>(
      "drucker_prager density 200 d 5e3 beta 30 psi 10 elasticity linear E 13.79e6 nu 0.3");
  for (const std::string more : {"", "sensitivity 4 slip_95 0.05"})
    expect_instruction_sets_to_agree<UndrainedClay, UndrainedClayKernels>(
        "undrained_clay density 200 su 3e4 " + more + " elasticity linear E 13.79e6 nu 0.3");
  expect_instruction_sets_to_agree<CrushableFoam, CrushableFoamKernels>(
      "crushable_foam density 200 pt 11.376 sigma0 275.79 elasticity porous elasticity.kappa 0.005 "
      "elasticity.e0 3.5 pt_el 113.76 nu 0.3 hardening exponential pc0 113.76 lambda 0.35 "
      "hardening.kappa 0.005 hardening.e0 3.5");
  std::string tested;
  for (const InstructionSet set : available_instruction_sets())
    tested += std::string(" ") + to_string(set);
  RecordProperty("instruction_sets", tested);
}

/// ln U and R of any step, by eigenvalues of F^T F, through an elastic law: sigma = R (C : ln U)
/// R^T.
TEST(Kinematics, LogarithmicStrainAndRotationOfAnyStep) {
  const auto material =
      material_of("elastic density 1 elasticity linear E 2.5 nu 0.25");  // K = 5/3, G = 1
  std::mt19937 engine(5);
  std::normal_distribution<double> normal;
  for (const double size : {1e-9, 1e-5, 1e-2, 0.02, 0.03, 0.1, 0.3}) {
    for (int trial = 0; trial < 200; ++trial) {
      Matrix3 h;
      for (int k = 0; k < 9; ++k) h(k) = size * normal(engine);
      const Matrix3 F = Matrix3::Identity() + h;
      if (F.determinant() < 0.05) continue;
      VectorX state = material->initial_state();
      material->update_point(h, state);
      const Eigen::JacobiSVD<Matrix3> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
      const Matrix3 R = svd.matrixU() * svd.matrixV().transpose();
      const Matrix3 log_u = svd.matrixV() *
                            svd.singularValues().array().log().matrix().asDiagonal() *
                            svd.matrixV().transpose();
      const Matrix3 expected =
          R * ((5.0 / 3 - 2.0 / 3) * log_u.trace() * Matrix3::Identity() + 2 * log_u) *
          R.transpose();
      // The singular values themselves are known to 1e-16 only, so the reference for tiny steps is
      // the linear strain.
      const double error = (to_matrix(stress_of(state)) - expected).norm();
      ASSERT_LT(error, 2e-14 + 1e-12 * size) << size;
      if (size == 1e-9) {
        const Matrix3 e = 0.5 * (h + h.transpose());
        ASSERT_LT((to_matrix(stress_of(state)) - e.trace() * Matrix3::Identity() - 2 * e).norm(),
                  1e-16);
      }
      ASSERT_NEAR(state[field::volume_ratio], F.determinant(), 1e-14);
    }
  }
}

/// On both sides of the bound of the series for small steps, |H + H^T + H^T H| = 1e-4, against the
/// series of ln(F F^T) summed to its end in extended precision: a term that is missing would be
/// seen as 2e-13.
TEST(Kinematics, StrainOfSmallStepsIsExactToRounding) {
  using Precise = Eigen::Matrix<long double, 3, 3>;
  const auto material = material_of("elastic density 1 elasticity linear E 2.5 nu 0.25");
  std::mt19937 engine(6);
  std::normal_distribution<double> normal;
  for (const double size : {1e-6, 1e-5, 1.5e-5, 2e-5, 3e-5, 1e-4})
    for (int trial = 0; trial < 200; ++trial) {
      Matrix3 h;
      for (int k = 0; k < 9; ++k) h(k) = size * normal(engine);
      VectorX state = material->initial_state();
      material->update_point(h, state);
      const Precise precise = h.cast<long double>();
      const Precise x = precise + precise.transpose() + precise * precise.transpose();
      Precise power = x, twice_log = Precise::Zero();  // 2 R ln U R^T = ln(I + X)
      for (int k = 1; k <= 12; ++k) {
        twice_log += (k % 2 == 1 ? 1.0L : -1.0L) / static_cast<long double>(k) * power;
        power = power * x;
      }
      const Precise stress = 0.5L * twice_log.trace() * Precise::Identity() + twice_log;
      const Matrix3 expected = stress.cast<double>();
      ASSERT_LT((to_matrix(stress_of(state)) - expected).norm(), 1e-14 * expected.norm()) << size;
    }
}

}  // namespace
}  // namespace furrow::kernels_test
