// SPDX-License-Identifier: GPL-2.0-or-later
// Steps of the crushable foam end where its equations, in long double, hold; and how soon its
// kernel has solved them.

#include <random>

#include <gtest/gtest.h>

#include "furrow/material/models/crushable_foam/crushable_foam.h"
#include "tests/support/paths.h"

namespace furrow::foam_return_test {
namespace {

using testing_paths::material_of;
using testing_paths::strain_of;
using testing_paths::stretch;
using Real = long double;

constexpr Real kappa = 0.005L, e0 = 3.5L, pt = 11.376L;

/// Equations (17), (18) of crushable_foam.h for one step: the round section, porous elasticity.
struct Step {
  const CrushableFoam& law;
  Real p_n, eps_n, dv, q_trial, shear;  // dv compression positive

  /// p after a volumetric plastic strain De
  Real pressure(Real De) const {
    const ElasticityParameters& elasticity = law.parameters().elasticity;
    const Real c = (1 + e0) / kappa, limit = elasticity.limit, p0 = elasticity.p0;
    const Real ratio = 1 - std::log((p_n + limit) / (p0 + limit)) / c;
    return (p_n + limit) * std::exp(-c * ratio * std::expm1(-(dv - De))) - limit;
  }
  Real q(Real De) const {
    const Real p = std::abs(pressure(De));
    return De == 0 ? q_trial : q_trial * p / (p + 2 * shear * std::abs(De) / 3);
  }
  /// Excess of the yield function.
  Real excess(Real De) const {
    const Real pc = law.pc(static_cast<double>(eps_n + De));
    return std::hypot((pt - pc) / 2 + pressure(De), q(De) / law.parameters().M) - (pc + pt) / 2;
  }
};

/// Steps of one size from states that compaction, shear and stretching have spread over the
/// ellipse. The rounding of eps_vol_pl is 900 times as large in p: 2e-13.
TEST(CrushableFoam, RandomStepsSolveTheReturnEquations) {
  const auto material = material_of(
      "crushable_foam density 200 pt 11.376 sigma0 275.79 elasticity porous elasticity.kappa 0.005 "
      "elasticity.e0 3.5 pt_el 113.76 nu 0.3 hardening exponential pc0 113.76 lambda 0.35 "
      "hardening.kappa 0.005 hardening.e0 3.5");
  const auto& law = static_cast<const CrushableFoam&>(*material);
  std::mt19937 engine(11);
  std::normal_distribution<double> normal;
  for (const double size : {1e-7, 1e-5, 1e-4, 1e-3, 1e-2}) {
    std::size_t yielding = 0, iterations = 0, most = 0;
    for (int path = 0; path < 200; ++path) {
      VectorX state = material->initial_state();
      material->update_point(stretch(strain_of(-0.05, -0.05, -0.05 - 0.1 * (path % 7))), state);
      for (int step = 0; step < 10; ++step) {
        const double mean = size * normal(engine);
        const Vector6 strain = strain_of(mean + size * normal(engine), mean + size * normal(engine),
                                         mean + size * normal(engine));
        const VectorX before = state;
        const UpdateReport report = material->update_point(stretch(strain), state);
        const Invariants start = invariants(stress_of(before)),
                         found = invariants(stress_of(state));
        const Real shear = material->moduli(before).shear, dv = -strain.head<3>().sum();
        Vector6 trial = 2 * static_cast<double>(shear) * strain;
        trial.head<3>().array() += 2 * static_cast<double>(shear * dv) / 3 + start.p;
        trial += stress_of(before);
        const Real eps = before[CrushableFoam::eps_vol_pl];
        const Real De = state[CrushableFoam::eps_vol_pl] - eps;
        const Step equations{law, start.p, eps, dv, invariants(trial).q, shear};
        const double scale = 1e-9 * law.pc(state[CrushableFoam::eps_vol_pl]);
        ASSERT_NEAR(found.p, static_cast<double>(equations.pressure(De)), scale) << size;
        ASSERT_NEAR(found.q, static_cast<double>(equations.q(De)), scale) << size;
        ASSERT_LE(equations.excess(De), scale) << size;
        if (De != 0) {
          ASSERT_GE(equations.excess(De), -scale) << size;
        }
        yielding += De != 0 ? 1 : 0;
        iterations += report.iterations;
        most = std::max(most, report.max_iterations);
      }
    }
    EXPECT_GT(yielding, 400u) << size;
    if (size > 1e-4) continue;  // larger than the steps of an explicit computation
    EXPECT_LT(static_cast<double>(iterations), 6.0 * static_cast<double>(yielding)) << size;
    EXPECT_LT(most, 10u) << size;
  }
}

}  // namespace
}  // namespace furrow::foam_return_test
