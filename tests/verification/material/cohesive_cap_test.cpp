// SPDX-License-Identifier: GPL-2.0-or-later
// The cohesive cap law against closed forms of its equations (cohesive_cap.h).

#include "furrow/material/models/cohesive_cap/cohesive_cap.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/paths.h"

namespace furrow::cohesive_cap_test {
namespace {

using testing_paths::material_of;
using testing_paths::mixed_step;
using testing_paths::strain_of;
using testing_paths::stretch;

constexpr double density = 200, growth = 10, first_strength = 1e3;
double strength(double eps) { return first_strength * std::exp(growth * eps); }

struct Snow {
  double nu_p = 0.1, d = 2e3, exponent = 3, beta = 30, tension = 0.2;
  double E = 1e10;
  double aspect = 0;      ///< 0: associated
  double relaxation = 0;  ///< [s]

  double tan_beta() const { return std::tan(radians(beta)); }
  double flow() const { return 4.5 * (1 - 2 * nu_p) / (1 + nu_p); }
  double A() const { return aspect > 0 ? aspect : std::sqrt(flow()); }
  /// d at a plastic strain
  double cohesion(double eps) const { return d * std::exp(exponent * eps); }
  std::unique_ptr<Material> material(double eps = 0) const {
    std::string text = fmt::format(
        "cohesive_cap density {} nu_p {} d {:.17g} d_density {} d_exponent {} beta {} "
        "tension_ratio "
        "{} eps_vol_pl_0 {:.17g} elasticity linear E {} nu 0.2 hardening table p {} {:.17g} "
        "eps_vol_pl 0 1 interpolation log beyond extrapolate",
        density, nu_p, d, density, exponent, beta, tension, eps, E, first_strength, strength(1));
    if (aspect > 0) text += fmt::format(" aspect {}", aspect);
    if (relaxation > 0) text += fmt::format(" relaxation_time {:.17g}", relaxation);
    return material_of(text);
  }
};

double eps_of(const VectorX& state) { return state[CohesiveCap::eps_vol_pl]; }

/// Compression ends at p = pc, tension at p = -tension_ratio d, in any number of steps.
TEST(CohesiveCapClosedForm, IsotropicStrengthsAreTheClosedForm) {
  for (const Snow& snow : {Snow{}, Snow{0.3, 5e2, 1, 45, 0.9}, Snow{0, 1e4, 6, 10, 0.5}}) {
    const auto material = [&] {
      Snow soft = snow;
      soft.E = 1e6;
      return soft.material();
    }();
    for (const double strain : {0.5, 0.1, -0.05, -0.3}) {
      for (const int steps : {1, 3, 50}) {
        VectorX state = material->initial_state();
        for (int step = 0; step < steps; ++step)
          material->update_point(stretch(strain_of(-1, -1, -1) * (strain / 3 / steps)), state);
        const double p = invariants(stress_of(state)).p, eps = eps_of(state);
        EXPECT_NEAR(p / (strain > 0 ? strength(eps) : -snow.tension * snow.cohesion(eps)), 1.0,
                    1e-8);
        EXPECT_NEAR(eps + p / (1e6 / 1.8), strain, 1e-12);
      }
    }
  }
}

/// Below the shear line K0 = nu_p/(1 - nu_p), for all other keys.
TEST(CohesiveCapClosedForm, PlasticPoissonRatioSetsTheLateralStress) {
  for (const double nu_p : {0.0, 0.1, 0.2, 0.4})
    for (const double aspect : {0.0, 1.0, 3.0})
      for (const double beta : {0.0, 40.0}) {
        const Snow snow{nu_p, 1e5, 9, beta, 0.2, 1e13, aspect};
        const auto material = snow.material();
        VectorX state = material->initial_state();
        for (int step = 0; step < 100; ++step)
          material->update_point(stretch(strain_of(0, 0, -4e-3)), state);
        EXPECT_NEAR(state[0] / state[2], nu_p / (1 - nu_p), 1e-6) << nu_p << " " << aspect;
        const Invariants end = invariants(stress_of(state));
        EXPECT_NEAR(std::hypot(end.p, end.q / snow.A()) / strength(eps_of(state)), 1.0, 1e-9);
      }
}

/// Where the shear line limits q, the point stays in its corner with the cap.
TEST(CohesiveCapClosedForm, ShearLineRaisesTheLateralStress) {
  for (const Snow& snow : {Snow{0.1, 1e2, 3, 30, 0.1, 1e13}, Snow{0.1, 0, 0, 35, 0, 1e13},
                           Snow{0.05, 2e2, 1, 20, 0.1, 1e13, 3.0}}) {
    const auto material = snow.material();
    VectorX state = material->initial_state();
    for (int step = 0; step < 100; ++step)
      material->update_point(stretch(strain_of(0, 0, -4e-3)), state);
    const double eps = eps_of(state), d = snow.cohesion(eps), t = snow.tan_beta(), A = snow.A();
    // p^2 + ((d + p t)/A)^2 = pc^2
    const double a = 1 + t * t / (A * A), b = d * t / (A * A), c = d * d / (A * A);
    const double pc = strength(eps), p = (-b + std::sqrt(b * b - a * (c - pc * pc))) / a;
    const double q = d + p * t;
    EXPECT_NEAR(state[0] / state[2], (p - q / 3) / (p + 2 * q / 3), 1e-6);
    EXPECT_NEAR(-state[2] / (p + 2 * q / 3), 1.0, 1e-6);
    EXPECT_GT(state[0] / state[2], snow.nu_p / (1 - snow.nu_p));
  }
}

/// Simple shear inside the cap: (d + p tan(beta))/sqrt(3) and no change of volume.
TEST(CohesiveCapClosedForm, ShearStrengthGrowsWithDensity) {
  const Snow snow;
  for (const double rho : {300.0, 400.0, 480.0}) {
    const double eps = std::log(rho / density);
    const auto material = snow.material(eps);
    for (const double share : {0.0, 0.1, 0.3}) {
      const double p = share * strength(eps);
      VectorX state = material->initial_state();
      state.segment<3>(field::stress).setConstant(-p);
      Branch branch{};
      for (int step = 0; step < 20; ++step)
        material->update_point(stretch(strain_of(0, 0, 0, 1e-5)), state, &branch);
      EXPECT_EQ(branch, Branch::shear);
      const double d = snow.d * std::pow(rho / density, snow.exponent);
      EXPECT_NEAR(std::sqrt(3) * state[field::stress + 5] / (d + p * snow.tan_beta()), 1.0, 1e-6);
      EXPECT_NEAR(eps_of(state), eps, 1e-14);
    }
  }
}

/// Compression under sigma_c: q = (d + sigma_c tan(beta))/(1 - tan(beta)/3).
TEST(CohesiveCapClosedForm, TriaxialCompressionIsTheClosedForm) {
  Snow snow;
  snow.E = 1e8;
  const double eps = 0.6, pressure = 5e3, t = snow.tan_beta();
  const auto material = snow.material(eps);
  VectorX state = material->initial_state();
  state.segment<3>(field::stress).setConstant(-pressure);
  for (int step = 0; step < 300; ++step)
    mixed_step(*material, state, strain_of(1e-5, 1e-5, -2e-5), {true, true, false},
               Vector3::Constant(-pressure), 1e-9 * pressure);
  const double q = (snow.cohesion(eps) + pressure * t) / (1 - t / 3);
  EXPECT_NEAR(invariants(stress_of(state)).q / q, 1.0, 1e-6);
  EXPECT_NEAR(eps_of(state), eps, 1e-12);
}

/// On the cap sigma = 3 pc/sqrt(1 + 9/A^2). The lateral strain per axial strain is nu_p.
TEST(CohesiveCapClosedForm, UnconfinedCompressionIsTheClosedForm) {
  for (const double nu_p : {0.02, 0.1, 0.3})
    for (const double aspect : {0.0, 2.5}) {
      const Snow snow{nu_p, 1e5, 9, 30, 0.2, 1e10, aspect};
      const auto material = snow.material();
      VectorX state = material->initial_state();
      Vector6 last = Vector6::Zero();
      for (int step = 0; step < 50; ++step)
        last = mixed_step(*material, state, strain_of(2e-4, 2e-4, -1e-3), {true, true, false},
                          Vector3::Zero(), 1e-8 * first_strength);
      const double A = snow.A();
      EXPECT_NEAR(-state[2] / (3 * strength(eps_of(state)) / std::sqrt(1 + 9 / (A * A))), 1.0,
                  1e-5);
      EXPECT_NEAR(-last[0] / last[2], nu_p, 1e-5) << aspect;
    }
}

/// Uniaxial tension yields at the smaller of 3 tension_ratio d and d/(1 + tan(beta)/3).
TEST(CohesiveCapClosedForm, UniaxialTensionIsTheClosedForm) {
  for (const double tension : {0.1, 0.6}) {
    Snow snow;
    snow.tension = tension;
    const double eps = 0.5, d = snow.cohesion(eps),
                 T = std::min(3 * tension * d, d / (1 + snow.tan_beta() / 3));
    for (const double share : {1 - 1e-6, 1 + 1e-6}) {
      const auto material = snow.material(eps);
      VectorX state = material->initial_state();
      Branch branch{};
      const double e = share * T / snow.E;
      material->update_point(stretch(strain_of(-0.2 * e, -0.2 * e, e)), state, &branch);
      const Branch expected = tension < 0.3 ? Branch::tension : Branch::shear;
      EXPECT_EQ(branch, share > 1 ? expected : Branch::elastic) << tension;
    }
  }
}

/// Simple shear at a constant rate, then at rest: the overstress approaches 2 G t e' and decays,
/// both with the relaxation time t.
TEST(CohesiveCapClosedForm, OverstressInShearGrowsAndRelaxesExponentially) {
  Snow snow;
  snow.beta = 0;
  snow.E = 1e8;
  snow.relaxation = 0.02;
  const double eps = 0.6, shear = snow.E / 2.4, limit = snow.cohesion(eps) / std::sqrt(3);
  const auto material = snow.material(eps);
  EXPECT_TRUE(material->rate_dependent());
  EXPECT_FALSE(Snow{}.material()->rate_dependent());
  const int steps = 500;  // per relaxation time
  const double dt = snow.relaxation / steps, strain = limit / (2 * shear) / steps;
  VectorX state = material->initial_state();
  for (int step = 0; step < 4 * steps; ++step)  // yields after one relaxation time
    material->update_point(stretch(strain_of(0, 0, 0, strain)), state, nullptr, dt);
  EXPECT_NEAR(state[field::stress + 5] / limit, 2 - std::exp(-3.0), 1e-3);
  for (int step = 0; step < steps; ++step)
    material->update_point(Matrix3::Zero(), state, nullptr, dt);
  EXPECT_NEAR(state[field::stress + 5] / limit, 1 + (1 - std::exp(-3.0)) * std::exp(-1.0), 1e-3);
  EXPECT_NEAR(eps_of(state), eps, 1e-14);
}

/// Confined compression at a constant rate: the elastic stress of t e' adds to the strength.
TEST(CohesiveCapClosedForm, OverstressInConfinedCompressionIsProportionalToTheRate) {
  for (const double rate : {0.1, 1.0, 10.0}) {
    Snow snow{0.1, 1e6, 9, 30, 0.2, 1e10};
    snow.relaxation = 2e-6;
    const auto material = snow.material();
    VectorX state = material->initial_state();
    for (int step = 0; step < 400; ++step)
      material->update_point(stretch(strain_of(0, 0, -1e-3)), state, nullptr, 1e-3 / rate);
    const double slope = 2.0 / 3.0 * snow.flow(), A = snow.A();
    const double p = strength(eps_of(state)) / std::hypot(1.0, slope / A);
    const double modulus = snow.E * 0.8 / (1.2 * 0.6), lateral = 0.25 * modulus;
    const double over = snow.relaxation * rate;
    EXPECT_NEAR(-state[2] / (p * (1 + 2 * slope / 3) + modulus * over), 1.0, 2e-4) << rate;
    EXPECT_NEAR(-state[0] / (p * (1 - slope / 3) + lateral * over), 1.0, 2e-4) << rate;
  }
}

/// No step cools, and few large steps end near many small ones.
TEST(CohesiveCapClosedForm, FinalStateIsIndependentOfTheStep) {
  const Snow snow{0.1, 3e2, 3, 30, 0.2, 1e7};
  const auto material = snow.material(0.2);
  for (const Vector6& strain : {strain_of(0, 0, -0.2), strain_of(0.02, 0.01, -0.1, 0.05)}) {
    std::array<VectorX, 2> ends;
    for (std::size_t k = 0; k < 2; ++k) {
      const int steps = k == 0 ? 20 : 4000;
      ends[k] = material->initial_state();
      for (int step = 0; step < steps; ++step) {
        const double heat = ends[k][field::dissipated_energy];
        material->update_point(stretch(strain / steps), ends[k]);
        EXPECT_GE(ends[k][field::dissipated_energy], heat);
      }
    }
    EXPECT_NEAR((ends[0] - ends[1]).head<6>().norm() / ends[1].head<6>().norm(), 0.0, 0.01);
  }
}

}  // namespace
}  // namespace furrow::cohesive_cap_test
