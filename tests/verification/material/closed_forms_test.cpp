// SPDX-License-Identifier: GPL-2.0-or-later
// Laws against closed forms: cap and foam, [Shoop2001] eq 12-18; rubber, [Simo1998]; and against
// their own step size.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "furrow/material/models/crushable_foam/crushable_foam.h"
#include "furrow/material/models/drucker_prager_cap/drucker_prager_cap.h"
#include "tests/support/paths.h"

namespace furrow::closed_forms_test {
namespace {

using testing_paths::material_of;
using testing_paths::mccormick_sand;
using testing_paths::mixed_step;
using testing_paths::stretch;

Vector6 strain_of(double xx, double yy, double zz, double xy = 0, double yz = 0, double xz = 0) {
  return (Vector6() << xx, yy, zz, xy, yz, xz).finished();
}

/// Fresh snow with a cap of eccentricity R, [Shoop2001] Tables 1 and 3.
std::string snow(double R, const std::string& more = "") {
  return fmt::format(
      "drucker_prager_cap density 200 d 5e3 beta 22.53 R {} eps_vol_pl_0 0.001 elasticity linear E "
      "13.79e6 nu 0.3 "
      "hardening table p 113.76 5e4 1e5 2e5 5e5 1e6 2e6 2.8e6 3.25e6 6e6 6e7 "
      "eps_vol_pl 0 0.593 0.669 0.806 0.944 1.083 1.299 1.455 1.475 1.50 1.514 interpolation "
      "linear beyond extrapolate {}",
      R, more);
}

/// eps_v = p/K + H^-1(p) - eps_0 for any number of steps.
TEST(CapClosedForm, HydrostaticCompressionFollowsTheHardening) {
  const double K = 689e6 / 1.5;
  const std::vector<double> pb{0.138e6, 0.172e6, 0.434e6, 0.896e6, 1.655e6,
                               2.758e6, 4.137e6, 6.895e6, 13.447e6};
  const std::vector<double> eps{0, 0.005, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.1};
  const auto material = material_of(mccormick_sand());
  for (const int steps : {1, 3, 50}) {
    for (const double strain : {0.001, 0.01, 0.03, 0.09}) {
      VectorX state = material->initial_state();
      const Vector6 part = Vector6(strain_of(-1, -1, -1) * (strain / 3 / steps));
      for (int step = 0; step < steps; ++step) material->update_point(stretch(part), state);
      const double p = invariants(stress_of(state)).p;
      std::size_t k = 0;
      while (k + 2 < pb.size() && p > pb[k + 1]) ++k;
      const double inverse = eps[k] + (p - pb[k]) / (pb[k + 1] - pb[k]) * (eps[k + 1] - eps[k]);
      EXPECT_NEAR((p / K + inverse - 0.001) / strain, 1.0, 1e-12)
          << steps << " steps to " << strain;
    }
  }
}

TEST(CapClosedForm, FirstYieldOfMcCormickSandIsAt0144Megapascal) {
  const auto material = material_of(mccormick_sand());
  const double first = 0.138e6 + 0.2 * 0.034e6, K = 689e6 / 1.5;  // 0.1448 MPa
  for (const double share : {1 - 1e-9, 1 + 1e-9}) {
    VectorX state = material->initial_state();
    Branch branch{};
    material->update_point(stretch(strain_of(-1, -1, -1) * (share * first / K / 3)), state,
                           &branch);
    EXPECT_EQ(branch, share > 1 ? Branch::cap : Branch::elastic);
    EXPECT_NEAR(invariants(stress_of(state)).p, first, 1e-6 * first);
  }
}

/// The state on the cap in confined compression (facts 3): pa = (pb - R d)/(1 + R tan(beta)), Q = d
/// + pa tan(beta), y = 1/sqrt(1 + 2.25 R^2), q = y Q, p = pa + 1.5 R^2 y Q. It neglects elastic
/// strain, so it holds for R small and p << E.
TEST(CapClosedForm, ConfinedCompressionFollowsTheCap) {
  const double tan_beta = std::tan(radians(22.53)), d = 5e3;
  for (const double R : {1.1e-4, 1e-3, 5e-3}) {
    const auto material = material_of(snow(R));
    VectorX state = material->initial_state();
    const int steps = 4000;
    for (int step = 0; step < steps; ++step)
      material->update_point(stretch(strain_of(0, 0, -0.8 / steps)), state);
    const double pb =
        static_cast<const DruckerPragerCap&>(*material).pb(state[DruckerPragerCap::eps_vol_pl]);
    const double pa = (pb - R * d) / (1 + R * tan_beta), Q = d + pa * tan_beta,
                 y = 1 / std::sqrt(1 + 2.25 * R * R);
    const double q = y * Q, p = pa + 1.5 * R * R * y * Q;
    EXPECT_NEAR(-state[2] / (p + 2 * q / 3), 1.0, 1e-3) << "sigma1, R " << R;
    EXPECT_NEAR(-state[0] / (p - q / 3), 1.0, 1e-3) << "sigma3, R " << R;
  }
}

/// q = (d + sigma_c tan(beta))/(1 - tan(beta)/3) after triaxial compression at lateral stress
/// sigma_c, with p = pa.
TEST(CapClosedForm, TriaxialCompressionEndsInTheCriticalState) {
  const double tan_beta = std::tan(radians(14.56));
  const auto material = material_of(mccormick_sand());
  for (const auto& [pressure, known] :
       {std::pair{0.25e6, 1.37826e6}, std::pair{1e6, 1.59153e6}, std::pair{4e6, 2.44459e6}}) {
    VectorX state = material->initial_state();
    for (int step = 1; step <= 20; ++step)
      mixed_step(*material, state, Vector6::Zero(), {true, true, true},
                 Vector3::Constant(-pressure * step / 20), 1e-7 * pressure);
    for (int step = 0; step < 300; ++step)
      mixed_step(*material, state, strain_of(0, 0, -2e-3), {true, true, false},
                 Vector3::Constant(-pressure), 1e-8 * pressure);
    const Invariants end = invariants(stress_of(state));
    EXPECT_NEAR(end.q / ((1.194e6 + pressure * tan_beta) / (1 - tan_beta / 3)), 1.0, 1e-6);
    EXPECT_NEAR(end.q / known, 1.0, 4e-6);  // six digits are known
    EXPECT_NEAR(
        static_cast<const DruckerPragerCap&>(*material).pa(state[DruckerPragerCap::eps_vol_pl]) /
            end.p,
        1.0, 1e-6);
  }
}

/// With K < 1 the strength in triaxial extension is K times that in compression at the same p (t =
/// q/K there).
TEST(CapClosedForm, ExtensionHasTheFlowStressRatio) {
  const auto material = material_of(mccormick_sand("K 0.8"));
  const double tan_beta = std::tan(radians(14.56)), pressure = 1e6;
  VectorX state = material->initial_state();
  for (int step = 1; step <= 20; ++step)
    mixed_step(*material, state, Vector6::Zero(), {true, true, true},
               Vector3::Constant(-pressure * step / 20), 1e-7 * pressure);
  for (int step = 0; step < 300; ++step)
    mixed_step(*material, state, strain_of(0, 0, 2e-3), {true, true, false},
               Vector3::Constant(-pressure), 1e-8 * pressure);
  // p = sigma_c - q/3 and q/K = d + p tan(beta)
  const double q = (1.194e6 + pressure * tan_beta) / (1 / 0.8 + tan_beta / 3);
  EXPECT_NEAR(invariants(stress_of(state)).q / q, 1.0, 1e-6);
}

/// Differences of results with n, 2n, 4n steps fall by 2 each time: backward Euler is of first
/// order.
TEST(StepSize, StressConvergesAtFirstOrder) {
  for (const std::string& text :
       {mccormick_sand(), mccormick_sand("alpha 0.05"), mccormick_sand("K 0.8"),
        mccormick_sand("K 0.7 section matsuoka_nakai"), snow(0.02)}) {
    const auto material = material_of(text);
    std::array<Vector6, 4> ends;
    for (std::size_t level = 0; level < ends.size(); ++level) {
      const int steps = 400 << level;
      VectorX state = material->initial_state();
      // Shear and compaction at a turning rate: the path is not radial.
      for (int step = 0; step < steps; ++step) {
        const double middle = (step + 0.5) / steps;
        const Vector6 rate = strain_of(-0.004 * (1 + middle), 0.002 * middle,
                                       -0.004 * std::cos(3 * middle), 0.003 * middle, 0, 0.003);
        material->update_point(stretch(rate / steps), state);
      }
      ends[level] = stress_of(state);
    }
    const double first = (ends[1] - ends[0]).norm(), second = (ends[2] - ends[1]).norm(),
                 third = (ends[3] - ends[2]).norm();
    EXPECT_NEAR(std::log2(first / second), 1.0, 0.15) << text;
    EXPECT_NEAR(std::log2(second / third), 1.0, 0.15) << text;
    EXPECT_LT(third, 2e-4 * ends[3].norm()) << text;
  }
}

/// Radial paths: the result does not depend on how the path is split, to the accuracy of the return
/// mapping.
TEST(StepSize, RadialPathIsIndependentOfTheStep) {
  struct Case {
    std::string material;
    Vector6 strain;
  };
  // Hydrostatic on the cap; pure tension to the apex; uniaxial compression of the foam, whose flow
  // (18) is radial there.
  const std::string foam =
      "crushable_foam density 200 pt 11.376 sigma0 275.79 elasticity linear E 1e6 nu 0 "
      "hardening exponential pc0 113.76 lambda 0.35 kappa 0.005 e0 3.5";
  const std::vector<Case> cases{{snow(0.02), strain_of(-0.2, -0.2, -0.2)},
                                {snow(0.02), strain_of(0.01, 0.01, 0.01)},
                                {mccormick_sand("tension 1e5"), strain_of(0.002, 0.002, 0.002)},
                                {foam, strain_of(-0.1, -0.1, -0.1)}};
  for (const Case& c : cases) {
    const auto material = material_of(c.material);
    std::vector<VectorX> ends;
    for (const int steps : {1, 7, 100}) {
      VectorX state = material->initial_state();
      for (int step = 0; step < steps; ++step)
        material->update_point(stretch(c.strain / steps), state);
      ends.push_back(state);
    }
    for (const VectorX& end : ends) {
      EXPECT_LT((stress_of(end) - stress_of(ends[0])).norm(), 1e-10 * material->stress_scale(end))
          << c.material;
      EXPECT_NEAR(end[field::internal], ends[0][field::internal], 1e-12) << c.material;
    }
  }
}

/// Uneven splittings of the same proportional path agree within the first-order error of the coarse
/// one.
TEST(StepSize, LargeStepsAgreeWithTinySteps) {
  const auto material = material_of(mccormick_sand());
  VectorX coarse = material->initial_state(), fine = coarse;
  const Vector6 strain = strain_of(0, 0, -0.05);
  for (int step = 0; step < 25; ++step) material->update_point(stretch(strain / 25), coarse);
  for (int step = 0; step < 5000; ++step) material->update_point(stretch(strain / 5000), fine);
  EXPECT_LT((stress_of(coarse) - stress_of(fine)).norm(), 1e-4 * stress_of(fine).norm());
}

// ---- foam ---------------------------------------------------------------------------------------

const std::string stiff_foam =
    "crushable_foam density 200 pt 11.376 sigma0 275.79 elasticity linear E 1e7 nu 0.3 "
    "hardening exponential pc0 113.76 lambda 0.35 kappa 0.005 e0 3.5 ";

TEST(FoamClosedForm, UniaxialStrengthSetsTheAspectOfTheEllipse) {
  const auto material = material_of(stiff_foam);
  EXPECT_NEAR(static_cast<const CrushableFoam&>(*material).parameters().M, 5.807, 5e-4);  // facts 9
  VectorX state = material->initial_state();
  state[2] = -275.79;  // uniaxial compression at the initial strength lies on the ellipse
  EXPECT_NEAR(material->yield_function(state), 0.0, 1e-10 * 275.79);
  const auto other = material_of(stiff_foam + "pc0_reading pc0_plus_pt");
  EXPECT_NEAR(static_cast<const CrushableFoam&>(*other).pc(0.0), 113.76 - 11.376, 1e-10);
  VectorX end = other->initial_state();
  end[2] = -275.79;
  EXPECT_NEAR(other->yield_function(end), 0.0, 1e-10 * 275.79);
}

/// Uniaxial compression: the first yield is at sigma0, and by flow (18) there is no lateral plastic
/// strain, so the lateral strain is elastic: nu sigma/E.
TEST(FoamClosedForm, UniaxialCompressionHasNoLateralPlasticStrain) {
  const auto material = material_of(stiff_foam);
  VectorX state = material->initial_state();
  double lateral = 0;
  for (int step = 0; step < 100; ++step)
    lateral += mixed_step(*material, state,
                          step == 0 ? strain_of(6e-6, 6e-6, -2e-5) : strain_of(0, 0, -2e-3),
                          {true, true, false}, Vector3::Zero(), 1e-6)[0];
  EXPECT_GT(-state[2], 275.79);
  EXPECT_NEAR(lateral, 0.3 * -state[2] / 1e7, 1e-9);
  EXPECT_NEAR(state[CrushableFoam::eps_vol_pl], 2e-5 + 99 * 2e-3 + state[2] / 1e7, 1e-9);
  // a plastic strain e along one axis alone: sqrt(2/3 de:de) of its deviator is 2/3 e
  EXPECT_NEAR(state[CrushableFoam::eps_dev_pl], 2.0 / 3.0 * state[CrushableFoam::eps_vol_pl], 1e-9);
}

/// Confined compression without Poisson's ratio is uniaxial stress too: q = 3 p = sigma_1 on the
/// ellipse at pc(eps - sigma_1/E), which is
///   (1 + 9/M^2) p^2 - (pc - pt) p - pc pt = 0.
TEST(FoamClosedForm, ConfinedCompressionHasNoLateralStress) {
  const double E = 1e7, pt = 11.376;
  const auto material = material_of(
      "crushable_foam density 200 pt 11.376 sigma0 275.79 elasticity linear E 1e7 nu 0 "
      "hardening exponential pc0 113.76 lambda 0.35 kappa 0.005 e0 3.5");
  const double M = static_cast<const CrushableFoam&>(*material).parameters().M, a = 1 + 9 / (M * M);
  VectorX state = material->initial_state();
  for (const double strain : {0.1, 0.3, 0.6, 0.9}) {  // 221, 270, 364, 492 kg/m3
    const double before = std::log(state[field::volume_ratio]);
    for (int step = 0; step < 10; ++step)
      material->update_point(stretch(strain_of(0, 0, -(strain + before) / 10)), state);
    const double sigma1 = -state[2], J_pl = std::exp(sigma1 / E - strain);
    const double pc = (113.76 + pt) * std::exp(4.5 * (1 - J_pl) / (0.35 - 0.005 * J_pl)) - pt,
                 half = 0.5 * (pc - pt);
    EXPECT_NEAR(sigma1 / (3 * (half + std::sqrt(half * half + a * pc * pt)) / a), 1.0, 1e-10)
        << strain;
    EXPECT_NEAR(state[0] / sigma1, 0.0, 1e-10) << strain;
  }
}

/// Hydrostatic compression follows p = pc, tension p = -pt at any volume.
TEST(FoamClosedForm, HydrostaticStrengthsAreTheParameters) {
  const auto material = material_of(stiff_foam);
  for (const double strain : {-0.3, 0.05}) {
    VectorX state = material->initial_state();
    for (int step = 0; step < 10; ++step)
      material->update_point(stretch(strain_of(1, 1, 1) * (strain / 30)), state);
    const double eps = state[CrushableFoam::eps_vol_pl], J_pl = std::exp(-eps);
    const double pc =
        (113.76 + 11.376) * std::exp(4.5 * (1 - J_pl) / (0.35 - 0.005 * J_pl)) - 11.376;
    EXPECT_NEAR(invariants(stress_of(state)).p / (strain < 0 ? pc : -11.376), 1.0, 1e-10);
    EXPECT_NEAR(eps + invariants(stress_of(state)).p / (1e7 / 1.2), -strain, 1e-12);
  }
}

// ---- porous elasticity, rubber ------------------------------------------------------------------

/// kappa/(1 + e0) ln((p0 + pt)/(p + pt)) = J_el - 1, in steps of any size, and back.
TEST(PorousClosedForm, PressureFollowsTheLogarithm) {
  const auto material =
      material_of("elastic density 200 elasticity porous kappa 0.05 e0 3.5 p0 100 pt_el 50 G 1e4");
  for (const double J : {0.98, 0.9, 1.01}) {
    const double expected = 150 * std::exp(4.5 / 0.05 * (1 - J)) - 50;
    for (const int steps : {1, 30}) {
      VectorX state = material->initial_state();
      EXPECT_NEAR(invariants(stress_of(state)).p, 100, 1e-12);
      const Vector6 part = strain_of(1, 1, 1) * (std::log(J) / 3 / steps);
      for (int step = 0; step < steps; ++step) material->update_point(stretch(part), state);
      EXPECT_NEAR(invariants(stress_of(state)).p / expected, 1.0, 1e-11) << J;
      for (int step = 0; step < steps; ++step) material->update_point(stretch(-part), state);
      EXPECT_NEAR(invariants(stress_of(state)).p, 100, 1e-8) << J;
    }
  }
}

/// sigma = (mu/J) J^(-2/3) dev b + (K/2)(J - 1/J) I for a simple shear and a uniaxial stretch, and
/// energy = work.
TEST(RubberClosedForm, SimpleShearAndStretchHaveStressAndEnergy) {
  const double mu = 1e6, K = 5e6;
  const auto material = material_of("neo_hookean density 1100 G 1e6 bulk 5e6");
  VectorX state = material->initial_state();
  Matrix3 gradient = Matrix3::Zero();
  gradient(0, 1) = 0.7;  // F = I + 0.7 e_x e_y: b = [1.49 0.7; 0.7 1]
  material->update_point(gradient, state);
  const double mean = (1.49 + 1 + 1) / 3;
  EXPECT_NEAR(state[0], mu * (1.49 - mean), 1e-9 * mu);
  EXPECT_NEAR(state[1], mu * (1 - mean), 1e-9 * mu);
  EXPECT_NEAR(state[3], mu * 0.7, 1e-9 * mu);
  EXPECT_NEAR(state[field::stored_energy], 0.5 * mu * 0.49, 1e-9 * mu);

  state = material->initial_state();
  const int steps = 2000;
  double work = 0;
  const double stretch_end = 1.8;
  for (int step = 0; step < steps; ++step) {
    const double from = 1 + (stretch_end - 1) * step / steps,
                 to = 1 + (stretch_end - 1) * (step + 1) / steps;
    const double before = state[0];
    Matrix3 h = Matrix3::Zero();
    h(0, 0) = to / from - 1;
    material->update_point(h, state);
    // first Piola-Kirchhoff stress = Cauchy stress at constant section
    work += 0.5 * (before + state[0]) * (to - from);
  }
  const double J = stretch_end, iso = std::pow(J, -2.0 / 3);
  const double sigma = mu / J * iso * (J * J - (J * J + 2) / 3) + 0.5 * K * (J - 1 / J);
  EXPECT_NEAR(state[0] / sigma, 1.0, 1e-11);
  EXPECT_NEAR(work / state[field::stored_energy], 1.0, 1e-6);
}

}  // namespace
}  // namespace furrow::closed_forms_test
