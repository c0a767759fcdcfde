// SPDX-License-Identifier: GPL-2.0-or-later
// The stress of resistive force theory on a face, against the angles of its paper, and the sense of
// its signs.

#include "furrow/scm/rft_law.h"

#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace furrow::rft_law_test {
namespace {

constexpr double rough = 1e6;  // friction that never limits

Vector3 total(const RftStress& stress) { return stress.normal + stress.tangent; }

/// Pairs of an outward normal and a direction of motion that point to one side.
struct Faces {
  std::mt19937 generator{7};
  Vector3 direction() {
    std::normal_distribution<double> component;
    return Vector3(component(generator), component(generator), component(generator)).normalized();
  }
  std::pair<Vector3, Vector3> next() {
    const Vector3 n = direction(), v = direction();
    return {n, n.dot(v) < 0.0 ? Vector3(-v) : v};
  }
};

/// By the angles beta, gamma and psi of [Agarwal2023]: components along r, theta and z.
Vector3 by_angles(double beta, double gamma, double psi) {
  const double a = std::sin(gamma), b = std::cos(beta),
               c = std::cos(psi) * std::cos(gamma) * std::sin(beta) + a * b;
  // by power of a, b and c
  struct Term {
    int a, b, c;
    double f1, f2, f3;
  };
  constexpr std::array<Term, 20> terms = {
      {{0, 0, 0, .00212, -.06796, -.02634},  {1, 0, 0, -.02320, -.10941, -.03436},
       {0, 1, 0, -.20890, .04725, .45256},   {0, 0, 1, -.43083, -.06914, .00835},
       {2, 0, 0, -.00259, -.05835, .02553},  {0, 2, 0, .48872, -.65880, -1.31290},
       {0, 0, 2, -.00415, -.11985, -.05532}, {1, 1, 0, .07204, -.25739, .06790},
       {0, 1, 1, -.02750, -.26834, -.16404}, {1, 0, 1, -.08772, .02692, .02287},
       {3, 0, 0, .01992, -.00736, .02927},   {0, 3, 0, -.45961, .63758, .95406},
       {0, 0, 3, .40799, .08997, -.00131},   {1, 2, 0, -.10107, .21069, -.11028},
       {2, 1, 0, -.06576, .04748, .01487},   {0, 1, 2, .05664, .20406, -.02730},
       {0, 2, 1, -.09269, .18589, .10911},   {2, 0, 1, .01892, .04934, -.04097},
       {1, 0, 2, .01033, .13527, .07881},    {1, 1, 1, .15120, -.33207, -.27519}}};
  Vector3 f = Vector3::Zero();
  for (const Term& term : terms)
    f += std::pow(a, term.a) * std::pow(b, term.b) * std::pow(c, term.c) *
         Vector3(term.f1, term.f2, term.f3);
  return {f[0] * std::sin(beta) * std::cos(psi) + f[1] * std::cos(gamma),
          f[0] * std::sin(beta) * std::sin(psi), -f[0] * b - f[1] * a - f[2]};
}

TEST(RftLaw, LevelPlateAndUprightPlateHaveTheValuesOfThePaper) {
  const Vector3 down = -Vector3::UnitZ(), ahead = Vector3::UnitX();
  EXPECT_NEAR(total(rft_stress(down, down, rough)).z(), 0.875, 5e-4);
  EXPECT_NEAR(rft_stress(down, down, rough).tangent.norm(), 0.0, 1e-15);
  EXPECT_NEAR(total(rft_stress(ahead, ahead, rough)).x(), -0.192, 5e-4);
}

TEST(RftLaw, VectorFormEqualsTheAnglesOfThePaper) {
  int compared = 0;
  for (double beta = -1.5; beta < 1.55; beta += 0.25)
    for (double psi = -1.5; psi < 1.55; psi += 0.5)
      for (double gamma = -1.4; gamma < 1.45; gamma += 0.4) {
        const Vector3 v(std::cos(gamma), 0.0, -std::sin(gamma));
        Vector3 n(std::sin(beta) * std::cos(psi), std::sin(beta) * std::sin(psi), -std::cos(beta));
        if (n.dot(v) < 0.0) n = -n;
        Vector3 expected = by_angles(beta, gamma, psi);
        const double pressure = -expected.dot(n);
        if (pressure <= 0.0) continue;  // sand does not pull
        const Vector3 along = expected + pressure * n;
        if (along.dot(v) > 0.0) expected -= 2.0 * along;
        EXPECT_NEAR((total(rft_stress(n, v, rough)) - expected).norm(), 0.0, 1e-14);
        ++compared;
      }
  EXPECT_GT(compared, 500);
}

TEST(RftLaw, StressRotatesAboutTheVerticalAndMirrors) {
  Faces faces;
  for (int sample = 0; sample < 1000; ++sample) {
    const auto [n, v] = faces.next();
    const Vector3 stress = total(rft_stress(n, v, 0.4));
    const Matrix3 turn = Eigen::AngleAxisd(0.01 * sample, Vector3::UnitZ()).toRotationMatrix();
    EXPECT_NEAR((total(rft_stress(turn * n, turn * v, 0.4)) - turn * stress).norm(), 0.0, 1e-14);
    const Vector3 mirror(1.0, -1.0, 1.0);
    EXPECT_EQ(total(rft_stress(n.cwiseProduct(mirror), v.cwiseProduct(mirror), 0.4)),
              stress.cwiseProduct(mirror));
  }
}

TEST(RftLaw, StressDissipatesPushesAndObeysFriction) {
  Faces faces;
  for (int sample = 0; sample < 10000; ++sample) {
    const auto [n, v] = faces.next();
    const RftStress stress = rft_stress(n, v, 0.3);
    EXPECT_LE(stress.normal.dot(v), 1e-15);
    EXPECT_LE(stress.tangent.dot(v), 1e-15);
    EXPECT_LE(stress.normal.dot(n), 0.0);
    EXPECT_NEAR(stress.tangent.dot(n), 0.0, 1e-15);
    EXPECT_LE(stress.tangent.norm(), 0.3 * stress.normal.norm() * (1.0 + 1e-12));
    EXPECT_EQ(rft_stress(n, v, 0.0).tangent.norm(), 0.0);
    if (n.dot(v) > 1e-6) {
      EXPECT_EQ(total(rft_stress(n, -v, 0.3)), Vector3(Vector3::Zero()));
    }
  }
}

TEST(RftLaw, StressOnUprightFacesIsInsensitiveToRounding) {
  const Vector3 ahead = Vector3::UnitX();
  const Vector3 expected = total(rft_stress(ahead, ahead, 0.5));
  for (const double error : {-1e-16, 1e-16})
    EXPECT_NEAR((total(rft_stress(Vector3(1.0, 0.0, error), ahead, 0.5)) - expected).norm(), 0.0,
                1e-14);
  // the sides of a wheel that runs straight ahead
  const Vector3 side = Vector3::UnitY(), down(0.6, 0.0, -0.8);
  const Vector3 rubbed = total(rft_stress(side, down, 0.5));
  EXPECT_GT(rubbed.norm(), 1e-3);
  for (const double error : {-1e-16, 1e-16})
    EXPECT_NEAR((total(rft_stress(side, down + error * side, 0.5)) - rubbed).norm(), 0.0, 1e-14);
}

/// Sums over small parts of the triangle.
Vector3 summed_moments(const Vector3& depth, int parts) {
  Vector3 sum = Vector3::Zero();
  for (int i = 0; i < parts; ++i)
    for (int j = 0; j < parts - i; ++j)
      for (const double shift : {1.0 / 3.0, 2.0 / 3.0}) {
        if (shift > 0.5 && i + j + 2 > parts) continue;
        const double b = (i + shift) / parts, c = (j + shift) / parts;
        const Vector3 weights(1.0 - b - c, b, c);
        sum += std::max(0.0, weights.dot(depth)) * weights;
      }
  return sum / (parts * parts);
}

TEST(RftLaw, DepthIntegralsCoverTheSubmergedPartAlone) {
  for (const Vector3& depth :
       {Vector3(0.3, 0.1, 0.2), Vector3(0.3, -0.1, -0.2), Vector3(-0.3, 0.1, 0.2),
        Vector3(0.1, 0.2, -0.05), Vector3(-0.2, 0.3, -0.4), Vector3(0.0, 0.1, 0.2),
        Vector3(0.0, -0.1, 0.2)}) {
    const Vector3 moments = depth_moments(depth);
    EXPECT_NEAR((moments - summed_moments(depth, 400)).norm(), 0.0, 2e-6 * depth.norm())
        << depth.transpose();
  }
  EXPECT_EQ(depth_moments(Vector3(-0.1, -0.2, 0.0)), Vector3(Vector3::Zero()));
}

}  // namespace
}  // namespace furrow::rft_law_test
