// SPDX-License-Identifier: GPL-2.0-or-later
// The deviatoric sections of the cap law: the smooth one against the cones that it is the section
// of, and the strength in triaxial compression, extension and plane strain against closed forms.

#include <random>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "furrow/material/models/drucker_prager_cap/drucker_prager_cap.h"
#include "furrow/material/section/section.h"
#include "tests/support/paths.h"

namespace furrow::deviatoric_section_test {
namespace {

using testing_paths::material_of;
using testing_paths::stretch;
using Kind = SectionParameters::Kind;

SectionParameters section_of(Kind kind, double K) {
  return {kind, K, (1 - K * K) / (1 + K * K * K)};
}

/// Principal stresses (tension positive) of pressure p and Mises stress q; theta from compression.
Vector6 principal(double p, double q, double theta) {
  Vector6 stress = Vector6::Zero();
  for (int i = 0; i < 3; ++i) stress[i] = -p - q * std::cos(theta - 2 * pi * i / 3) / 1.5;
  return stress;
}

/// x in [low, high] with f(x) = 0, f rising.
template <class Function>
double root(Function f, double low, double high) {
  for (int i = 0; i < 200; ++i) (f(0.5 * (low + high)) > 0 ? high : low) = 0.5 * (low + high);
  return 0.5 * (low + high);
}

struct Cone {
  std::string name;
  double (*value)(const Vector6& stress);  ///< constant on the cone, rising with q
};

double third_invariant(const Vector6& s) { return -s[0] * s[1] * s[2]; }
const Cone cones[] = {{"Matsuoka and Nakai",
                       [](const Vector6& s) {
                         const double second = s[0] * s[1] + s[1] * s[2] + s[2] * s[0];
                         return -(s[0] + s[1] + s[2]) * second / third_invariant(s);
                       }},
                      {"Lade and Duncan", [](const Vector6& s) {
                         return -std::pow(s[0] + s[1] + s[2], 3) / third_invariant(s);
                       }}};

/// Every point of either cone has one t, with K from its strengths in extension and compression.
TEST(DeviatoricSection, SectionIsThatOfMatsuokaNakaiAndLadeDuncan) {
  for (const Cone& cone : cones) {
    for (const double sine : {0.2, 0.4, 0.6, 0.7}) {
      const double p = 7e3, compression = p * 6 * sine / (3 - sine);
      const double level = cone.value(principal(p, compression, 0.0));
      const auto strength = [&](double theta) {
        return root([&](double q) { return cone.value(principal(p, q, theta)) - level; }, 0.0,
                    compression);
      };
      const double K = strength(pi / 3) / compression;
      if (cone.name == "Matsuoka and Nakai") {
        EXPECT_NEAR(K, (3 - sine) / (3 + sine), 1e-12);
      }
      const SectionParameters section = section_of(Kind::matsuoka_nakai, K);
      for (double theta = 0.05; theta < 1.04; theta += 0.1) {
        const Invariants at = invariants(principal(p, strength(theta), theta));
        EXPECT_NEAR(yield_measure(at, section) / compression, 1.0, 1e-10)
            << cone.name << " " << sine << " " << theta;
      }
    }
  }
}

/// t is a convex function of stress: between any two deviators it is below its mean.
TEST(DeviatoricSection, SectionIsConvex) {
  std::mt19937 engine(4);
  std::normal_distribution<double> normal;
  for (const SectionParameters& section :
       {section_of(Kind::abaqus, 0.778), section_of(Kind::abaqus, 0.9),
        section_of(Kind::matsuoka_nakai, 0.6), section_of(Kind::matsuoka_nakai, 0.8)}) {
    const auto measure = [&](const Vector6& stress) {
      return yield_measure(invariants(stress), section);
    };
    for (int pair = 0; pair < 3000; ++pair) {
      Vector6 a, b;
      for (int k = 0; k < 6; ++k) a[k] = normal(engine);
      for (int k = 0; k < 6; ++k) b[k] = normal(engine);
      if (pair % 2) b = a + 0.05 * b;  // neighbours find a dent that chords across pass over
      EXPECT_LE(measure(0.5 * (a + b)), 0.5 * (measure(a) + measure(b)) * (1 + 1e-12)) << section.K;
    }
  }
}

/// The stress in the critical state, reached by straining at constant volume in one direction, for
/// a cone of 40 degrees without cohesion: it does not depend on where it starts.
Vector6 critical_state(const std::string& keys, const Vector6& direction) {
  const auto material = material_of(
      "drucker_prager_cap density 1500 d 0 beta 40 R 0.3 eps_vol_pl_0 0.02 elasticity linear E 5e6 "
      "nu 0.2 hardening exponential pc0 2e4 lambda 0.03 hardening.kappa 0.001 hardening.e0 0.7 " +
      keys);
  const auto& cap = static_cast<const DruckerPragerCap&>(*material);
  VectorX state = material->initial_state();
  state.segment<3>(field::stress).setConstant(-0.7 * cap.pa(0.02));
  // the end in steps of a thousandth of the elastic strain: the direction of flow is exact to their
  // order
  for (const auto& [steps, size] : {std::pair{6000, 2e-4}, std::pair{10000, 1e-5}})
    for (int step = 0; step < steps; ++step)
      material->update_point(stretch(direction * (size / direction.norm())), state);
  const Vector6 stress = stress_of(state);
  EXPECT_NEAR(invariants(stress).p / cap.pa(state[DruckerPragerCap::eps_vol_pl]), 1.0, 1e-3)
      << keys;
  return stress;
}

double q_over_p(const Vector6& stress) { return invariants(stress).q / invariants(stress).p; }

Vector6 strain(double xx, double yy, double zz, double xz = 0) {
  return (Vector6() << xx, yy, zz, 0, 0, xz).finished();
}

/// Compression q = p tan(beta), extension K times that.
TEST(DeviatoricSection, CompressionAndExtensionHaveTheirStrength) {
  const double tangent = std::tan(radians(40));
  for (const auto& [keys, K] : {std::pair{"K 0.8", 0.8}, std::pair{"K 0.778", 0.778},
                                std::pair{"K 0.73 section matsuoka_nakai", 0.73},
                                std::pair{"K 0.6 section matsuoka_nakai", 0.6}}) {
    EXPECT_NEAR(q_over_p(critical_state(keys, strain(0.5, 0.5, -1))), tangent, 1e-6) << keys;
    EXPECT_NEAR(q_over_p(critical_state(keys, strain(-0.5, -0.5, 1))), K * tangent, 1e-6) << keys;
  }
}

/// Plane strain without change of volume, [Lade1975]: the section is that of I3 = const at a
/// separate mean stress p' = 2 q_c/(9 w), and flow normal to it has no strain along y where s2 = 2
/// s1 s3/(s1 + s3). With m = (s1 + s3)/2 that is s1 s3 = m (3 p' - 2 m) and I3 = m (3 p' - 2 m)^2.
/// The strain is turned too, so that the principal axes are not those of the grid.
TEST(DeviatoricSection, PlaneStrainHasItsStrength) {
  const double tangent = std::tan(radians(40));
  for (const double K : {0.65, 0.73, 0.85, 0.95}) {
    const double w = (1 - K * K) / (1 + K * K * K), mean = 2 * tangent / (9 * w);
    const double level =
        mean * mean * mean - mean * tangent * tangent / 3 + 2 * tangent * tangent * tangent / 27;
    // I3 falls with m from m = p' (no deviator) on, to 0 at 3 p'/2
    const double m =
        root([&](double x) { return level - x * std::pow(3 * mean - 2 * x, 2); }, mean, 1.5 * mean);
    const double product = m * (3 * mean - 2 * m), r = std::sqrt(m * m - product);
    const Vector3 known(m + r, product / m, m - r);  // s1, s2, s3 for a pressure of p'
    const Vector3 s = known.array() - mean;
    const double q = std::sqrt(1.5) * s.norm(), b = (known[1] - known[2]) / (known[0] - known[2]);
    const std::string keys = "section matsuoka_nakai K " + std::to_string(K);
    for (const Vector6& direction : {strain(1, 0, -1), strain(0, 0, 0, 1)}) {
      const Vector6 stress = critical_state(keys, direction);
      EXPECT_NEAR(q_over_p(stress) / q, 1.0, 2e-4) << K;
      Eigen::SelfAdjointEigenSolver<Matrix3> axes(-to_matrix(stress));
      const Vector3 found = axes.eigenvalues();  // rising
      EXPECT_NEAR((found[1] - found[0]) / (found[2] - found[0]), b, 1e-3) << K;
    }
  }
}

}  // namespace
}  // namespace furrow::deviatoric_section_test
