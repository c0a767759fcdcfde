// SPDX-License-Identifier: GPL-2.0-or-later
// McCormick Ranch sand ([Shoop2001] Tables 4, 5) along four laboratory paths: the implicit update
// of src/material against an independent explicit integration of the same rate equations
// (rate_reference.h), to 1e-6. The update is of first order in the step, so two step sizes are
// extrapolated to zero (Richardson) where the path is not radial.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rate_reference.h"
#include "tests/support/max_error.h"
#include "tests/support/paths.h"

namespace furrow::mccormick_sand_test {
namespace {

using testing_paths::material_of;
using testing_paths::mccormick_sand;
using testing_paths::stretch;

constexpr double reference_tolerance = 1e-13;

/// One leg of a path: a velocity gradient for a duration, some normal stresses held constant.
struct Leg {
  Matrix3 L;
  std::array<bool, 3> held;
  double duration;
};

Matrix3 axial(double rate) {
  Matrix3 L = Matrix3::Zero();
  L(2, 2) = rate;
  return L;
}

/// Delta F - I of a step under a constant velocity gradient: exp(L dt) - I.
Matrix3 flow(const Matrix3& L, double dt) {
  Matrix3 term = L * dt, sum = term;
  for (int k = 2; k < 30 && term.norm() > 1e-20; ++k) term = term * L * (dt / k), sum += term;
  return sum;
}

/// Stress and eps_vol_pl after every leg, by the law with `steps` steps a leg.
std::vector<Eigen::Matrix<double, 7, 1>> run(const Material& material, const std::vector<Leg>& legs,
                                             int steps) {
  VectorX state = material.initial_state();
  std::vector<Eigen::Matrix<double, 7, 1>> ends;
  for (const Leg& leg : legs) {
    const double dt = leg.duration / steps;
    const Vector6 target = stress_of(state);
    Matrix3 L = leg.L;
    for (int step = 0; step < steps; ++step) {
      std::vector<int> free;
      for (int i = 0; i < 3; ++i)
        if (leg.held[static_cast<std::size_t>(i)]) free.push_back(i);
      if (free.empty()) {
        material.update_point(flow(L, dt), state);
        continue;
      }
      // Newton's method on the held components; L of the last step is the first guess, the tangent
      // of the first iteration is kept.
      const auto n = static_cast<Eigen::Index>(free.size());
      VectorX next;
      const auto residual = [&](const Matrix3& velocity) {
        next = state;
        material.update_point(flow(velocity, dt), next);
        Eigen::VectorXd r(n);
        for (Eigen::Index i = 0; i < n; ++i)
          r[i] = next[free[std::size_t(i)]] - target[free[std::size_t(i)]];
        return r;
      };
      Eigen::VectorXd r = residual(L);
      for (int iteration = 0; iteration < 40 && r.norm() > 1e-8 * (1e5 + target.norm());
           ++iteration) {
        Eigen::MatrixXd jacobian(n, n);
        const double h = 1e-5;
        for (Eigen::Index j = 0; j < n; ++j) {
          Matrix3 up = L;
          up(free[std::size_t(j)], free[std::size_t(j)]) += h;
          jacobian.col(j) = (residual(up) - r) / h;
        }
        const Eigen::VectorXd change = jacobian.partialPivLu().solve(-r);
        for (Eigen::Index j = 0; j < n; ++j)
          L(free[std::size_t(j)], free[std::size_t(j)]) += change[j];
        r = residual(L);
      }
      if (r.norm() > 1e-7 * (1e5 + target.norm()))
        throw std::runtime_error("a held stress does not converge");
      state = next;
    }
    Eigen::Matrix<double, 7, 1> end;
    end << stress_of(state), state[*material.find_field("eps_vol_pl")];
    ends.push_back(end);
  }
  return ends;
}

std::vector<Eigen::Matrix<double, 7, 1>> run_reference(const std::vector<Leg>& legs) {
  const reference::CapRates material{reference::Sand{}};
  reference::Integrator integrator(material, reference_tolerance);
  reference::State y = material.initial();
  std::vector<Eigen::Matrix<double, 7, 1>> ends;
  for (const Leg& leg : legs) {
    y = integrator.advance(y, {leg.L, leg.held}, leg.duration);
    Eigen::Matrix<double, 7, 1> end;
    end << to_vector6(y.sigma), y.eps;
    ends.push_back(end);
  }
  return ends;
}

/// Compares leg by leg; stresses on the scale of the largest stress component, eps_vol_pl on its
/// own.
void expect_agreement(const std::vector<Leg>& legs, int steps, bool extrapolate, double tolerance) {
  const auto material = material_of(mccormick_sand());
  const auto expected = run_reference(legs);
  auto found = run(*material, legs, steps);
  if (extrapolate) {
    const auto finer = run(*material, legs, 2 * steps);
    for (std::size_t i = 0; i < legs.size(); ++i) found[i] = 2 * finer[i] - found[i];
  }
  test::MaxError worst;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const double scale = expected[i].head<6>().cwiseAbs().maxCoeff();
    const double stress = (found[i] - expected[i]).head<6>().cwiseAbs().maxCoeff() / scale;
    const double strain = std::abs(found[i][6] - expected[i][6]) / expected[i][6];
    worst.add(stress);
    worst.add(strain);
    EXPECT_LT(stress, tolerance) << "leg " << i << ": " << found[i].transpose() << "\nexpected "
                                 << expected[i].transpose();
    EXPECT_LT(strain, tolerance) << "leg " << i;
  }
  ::testing::Test::RecordProperty("worst_difference", fmt::format("{:.2e}", worst.max()));
}

TEST(McCormickSand, ConfinedCompressionTo8MegapascalFollowsTheRateForm) {
  // sigma1 = 8 MPa at an axial strain of 0.0707; the legs stop on the way, unload (elastic, then
  // into extension) and reload.
  const std::array<bool, 3> none{};
  const std::vector<Leg> legs{{axial(-1), none, 0.002}, {axial(-1), none, 0.008},
                              {axial(-1), none, 0.02},  {axial(-1), none, 0.0407},
                              {axial(1), none, 0.004},  {axial(1), none, 0.006}};
  expect_agreement(legs, 20000, true, 1e-6);
  EXPECT_NEAR(run_reference(legs)[3][2], -8e6, 0.15e6);
}

TEST(McCormickSand, HydrostaticCompressionFollowsTheRateForm) {
  const Matrix3 L = -Matrix3::Identity() / 3;
  const std::array<bool, 3> none{};
  expect_agreement(
      {{L, none, 0.0002}, {L, none, 0.005}, {L, none, 0.02}, {L, none, 0.04}, {-L, none, 0.005}},
      50, false, 1e-9);
}

class Triaxial : public ::testing::TestWithParam<std::tuple<double, double>> {};

/// Consolidated hydrostatically, then compressed axially at constant lateral stress.
TEST_P(Triaxial, TriaxialCompressionFollowsTheRateForm) {
  const auto [pressure, volume_strain] = GetParam();
  const std::array<bool, 3> none{}, lateral{true, true, false};
  const std::vector<Leg> legs{{-Matrix3::Identity() / 3, none, volume_strain},
                              {axial(-1), lateral, 0.001},
                              {axial(-1), lateral, 0.004},
                              {axial(-1), lateral, 0.015},
                              {axial(-1), lateral, 0.08},
                              {axial(-1), lateral, 0.3}};
  EXPECT_NEAR(run_reference(legs)[0][0] / -pressure, 1.0, 1e-4);
  expect_agreement(legs, 1500, true, 1e-6);
  const Eigen::Matrix<double, 7, 1> end = run_reference(legs).back();
  const double tan_beta = std::tan(radians(14.56));
  EXPECT_NEAR((end[0] - end[2]) / ((1.194e6 - end[0] * tan_beta) / (1 - tan_beta / 3)), 1.0,
              1e-6);  // q at the critical state
}
// Volume strains that give 0.25, 1 and 4 MPa: p/K + H^-1(p) - eps_0.
INSTANTIATE_TEST_SUITE_P(
    Pressures, Triaxial,
    ::testing::Values(std::tuple{0.25e6,
                                 0.25e6 / (689e6 / 1.5) + 0.005 + 0.078 / 0.262 * 0.005 - 0.001},
                      std::tuple{1e6, 1e6 / (689e6 / 1.5) + 0.02 + 0.104 / 0.759 * 0.01 - 0.001},
                      std::tuple{4e6, 4e6 / (689e6 / 1.5) + 0.04 + 1.242 / 1.379 * 0.01 - 0.001}));

class SimpleShear : public ::testing::TestWithParam<std::tuple<double, double>> {};

/// Consolidated hydrostatically, then sheared (v_x = rate z) at constant vertical stress without
/// lateral strain; the axes of stress turn and the Jaumann rate matters.
TEST_P(SimpleShear, SimpleShearAtConstantVerticalStressFollowsTheRateForm) {
  const auto [pressure, volume_strain] = GetParam();
  Matrix3 shear = Matrix3::Zero();
  shear(0, 2) = 1.0;
  const std::array<bool, 3> none{}, vertical{false, false, true};
  const std::vector<Leg> legs{{-Matrix3::Identity() / 3, none, volume_strain},
                              {shear, vertical, 0.002},
                              {shear, vertical, 0.006},
                              {shear, vertical, 0.022},
                              {shear, vertical, 0.07},
                              {-shear, vertical, 0.003}};
  EXPECT_NEAR(run_reference(legs)[0][0] / -pressure, 1.0, 1e-4);
  expect_agreement(legs, 3000, true, 1e-6);
}
INSTANTIATE_TEST_SUITE_P(Pressures, SimpleShear,
                         ::testing::Values(std::tuple{0.5e6, 0.5e6 / (689e6 / 1.5) + 0.01 +
                                                                 0.066 / 0.462 * 0.01 - 0.001},
                                           std::tuple{2e6, 2e6 / (689e6 / 1.5) + 0.03 +
                                                               0.345 / 1.103 * 0.01 - 0.001}));

}  // namespace
}  // namespace furrow::mccormick_sand_test
