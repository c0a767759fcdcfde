// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/registry.h"

#include <cmath>

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "tests/support/error_of.h"

namespace furrow::elastic_test {
namespace {

std::unique_ptr<Material> linear_elastic(double young, double nu) {
  return make_material(
      "elastic",
      MaterialSections{
          {"law", {{"density", {"1600"}}}},
          {"elasticity", {{"E", {std::to_string(young)}}, {"nu", {std::to_string(nu)}}}}});
}

/// A pure stretch of many sizes in one step: the logarithm of the stretch is exact, by hand.
TEST(Elastic, StressIsHookesLawOfTheLogarithmicStrain) {
  const auto material = linear_elastic(1e6, 0.25);  // K = 2/3 MPa, G = 0.4 MPa
  for (const double strain : {1e-12, 1e-6, 1e-3, 0.04, 0.06, 0.5, -1e-6, -0.04, -0.06, -0.5}) {
    VectorX state = material->initial_state();
    Matrix3 gradient = Matrix3::Zero();
    gradient(2, 2) = std::expm1(strain);
    material->update_point(gradient, state);
    EXPECT_NEAR(state[2] / strain, 1.2e6, 1.2e6 * 1e-12);
    EXPECT_NEAR(state[0] / strain, 0.4e6, 0.4e6 * 1e-12);
    EXPECT_NEAR(state[field::volume_ratio], std::exp(strain), 1e-14);
    EXPECT_NEAR(state[field::stored_energy], std::exp(strain) * 0.6e6 * strain * strain,
                0.6e6 * strain * strain * 1e-11);
  }
}

/// A rotation written in doubles is rigid to 1e-16 only, which the law rightly takes as strain: the
/// angle of the steps varies, so that this error of the input does not add up always in one
/// direction.
TEST(Elastic, ThousandTurnsOfRigidSpinKeepTheStress) {
  const auto material = linear_elastic(1e6, 0.25);
  VectorX state = material->initial_state();
  Matrix3 gradient;
  gradient << 1e-3, 4e-4, 0, 2e-4, -3e-3, 1e-4, 0, 5e-4, -2e-3;
  material->update_point(gradient, state);
  const Vector6 before = stress_of(state);
  const Vector3 axis = Vector3(1, 2, -0.5).normalized();
  double angle = 0.0;
  for (int step = 1; step <= 20000; ++step) {
    const double next = step < 20000 ? angle + 0.1 * pi * (1.0 + 0.5 * std::sin(step)) : 2000 * pi;
    const Matrix3 spin =
        Eigen::AngleAxisd(next - angle, axis).toRotationMatrix() - Matrix3::Identity();
    material->update_point(spin, state);
    angle = next;
  }
  EXPECT_LT((stress_of(state) - before).norm(), 1e-10 * before.norm());
  EXPECT_NEAR(state[field::volume_ratio], (Matrix3::Identity() + gradient).determinant(), 1e-12);
}

TEST(Elastic, RefusesAFoldedStepWithItsCause) {
  const auto material = linear_elastic(1e6, 0.25);
  VectorX state = material->initial_state();
  Matrix3 gradient = Matrix3::Zero();
  gradient(0, 0) = -1.5;
  EXPECT_THAT(test::error_of<StateError>([&] { material->update_point(gradient, state); }),
              ::testing::HasSubstr("folded"));
}

}  // namespace
}  // namespace furrow::elastic_test
