// SPDX-License-Identifier: GPL-2.0-or-later
// The cohesive Cam clay against closed forms of its equations (cohesive_cam_clay.h) and against an
// explicit integration of them.

#include "furrow/material/models/cohesive_cam_clay/cohesive_cam_clay.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/paths.h"

namespace furrow::cohesive_cam_clay_test {
namespace {

using testing_paths::material_of;
using testing_paths::mixed_step;
using testing_paths::strain_of;
using testing_paths::stretch;

/// Strength p0 = 1 kPa exp(10 eps), for eps of either sign.
constexpr double first_strength = 1e3, growth = 10;
double strength(double eps) { return first_strength * std::exp(growth * eps); }

std::string clay(double M, double beta, double E, double nu = 0.2, double eps = 0) {
  return fmt::format(
      "cohesive_cam_clay density 200 M {} tension_ratio {} eps_vol_pl_0 {} elasticity linear E {} "
      "nu {} hardening table p {} {:.17g} eps_vol_pl 0 1 interpolation log beyond extrapolate",
      M, beta, eps, E, nu, first_strength, strength(1));
}

const CohesiveCamClay& law_of(const Material& material) {
  return static_cast<const CohesiveCamClay&>(material);
}
double eps_of(const VectorX& state) { return state[CohesiveCamClay::eps_vol_pl]; }

struct Shape {
  double M, beta;
  double aspect() const { return M / std::sqrt(1 + 2 * beta); }
};
const Shape shapes[] = {{0.6, 0},   {1.2, 0.1}, {3.3, 0}, {3.3, 0.1},
                        {3.3, 0.5}, {3.1, 1},   {8, 0.02}};

/// Compression ends at p = p0, tension at p = -beta p0, with p0 of the strain that elasticity
/// leaves, in any number of steps.
TEST(CamClayClosedForm, IsotropicStrengthsAreTheClosedForm) {
  const double E = 1e6, K = E / 1.8;
  for (const Shape& shape : shapes) {
    const auto material = material_of(clay(shape.M, shape.beta, E));
    for (const double strain : {0.5, 0.1, -0.05, -0.5}) {
      for (const int steps : {1, 3, 50}) {
        VectorX state = material->initial_state();
        for (int step = 0; step < steps; ++step)
          material->update_point(stretch(strain_of(-1, -1, -1) * (strain / 3 / steps)), state);
        const double p = invariants(stress_of(state)).p, p0 = strength(eps_of(state));
        EXPECT_NEAR(p / p0, strain > 0 ? 1.0 : -shape.beta, 1e-9) << shape.M << " " << shape.beta;
        EXPECT_NEAR(eps_of(state) + p / K, strain, 1e-12 * std::abs(strain) + 1e-15);
      }
    }
  }
}

/// Confined compression of stiff snow: the point of the ellipse where d(eps_q)/d(eps_v) = 2/3,
/// K0 of M and beta, and the M of that K0. Elastic strain is 5e-8 of the plastic.
TEST(CamClayClosedForm, ConfinedCompressionIsTheClosedForm) {
  for (const Shape& shape : shapes) {
    const auto material = material_of(clay(shape.M, shape.beta, 1e13));
    VectorX state = material->initial_state();
    for (int step = 0; step < 100; ++step)
      material->update_point(stretch(strain_of(0, 0, -4e-3)), state);
    const double B = shape.aspect(), S = std::sqrt(9 + 4 * B * B), beta = shape.beta;
    const double p0 = strength(eps_of(state)), c = (1 - beta) * p0 / 2, a = (1 + beta) * p0 / 2;
    const Invariants end = invariants(stress_of(state));
    EXPECT_NEAR(end.p / (c + 3 * a / S), 1.0, 1e-6) << shape.M << " " << beta;
    EXPECT_NEAR(end.q / (2 * B * B * a / S), 1.0, 1e-6) << shape.M << " " << beta;
    const double K0 = ((1 - beta) * S + (1 + beta) * (3 - 2 * B * B / 3)) /
                      ((1 - beta) * S + (1 + beta) * (3 + 4 * B * B / 3));
    EXPECT_NEAR(state[0] / state[2], K0, 1e-6) << shape.M << " " << beta;
    const double eta = end.q / end.p, k = (1 - beta) / (1 + beta);
    const double root = eta * k + std::sqrt(eta * eta * k * k + 6 * eta + 9);
    EXPECT_NEAR(std::sqrt((1 + 2 * beta) * (root * root - 9)) / 2, shape.M, 1e-5 * shape.M);
  }
}

/// Triaxial compression at the lateral stress sigma_c ends in the critical state p = c, q = B a,
/// from any density at the start: q = N p with N = B (1 + beta)/(1 - beta), and p = sigma_c/(1 -
/// N/3), p0 = 2 p/(1 - beta).
TEST(CamClayClosedForm, TriaxialCompressionEndsInTheCriticalState) {
  const double pressure = 2e3;
  for (const Shape& shape : {Shape{0.6, 0}, Shape{1.2, 0.1}, Shape{1.8, 0.05}}) {
    const double N = shape.aspect() * (1 + shape.beta) / (1 - shape.beta);
    for (const double start : {0.1, 0.35}) {  // p0 = 2.7 and 33 kPa
      const auto material = material_of(clay(shape.M, shape.beta, 1e7, 0.2, start));
      VectorX state = material->initial_state();
      state.segment<3>(field::stress).setConstant(-pressure);
      for (int step = 0; step < 1500; ++step)
        mixed_step(*material, state, strain_of(1e-3, 1e-3, -2e-3), {true, true, false},
                   Vector3::Constant(-pressure), 1e-9 * pressure);
      const Invariants end = invariants(stress_of(state));
      EXPECT_NEAR(end.p / (pressure / (1 - N / 3)), 1.0, 1e-5) << shape.M << " from " << start;
      EXPECT_NEAR(end.q / (N * end.p), 1.0, 1e-5) << shape.M << " from " << start;
      EXPECT_NEAR(strength(eps_of(state)) / (2 * end.p / (1 - shape.beta)), 1.0, 1e-5);
    }
  }
}

/// Compression with free sides: q = 3 p on the ellipse, and the lateral strain per axial strain
/// that flow gives there, (r - 2/3)/(2 r + 2/3) with r = d(eps_q)/d(eps_v) = 3 p/(B^2 (p - c)).
TEST(CamClayClosedForm, UnconfinedCompressionIsTheClosedForm) {
  for (const Shape& shape : {Shape{3.3, 0.02}, Shape{3.3, 0.1}, Shape{3.3, 0.3}, Shape{5, 0}}) {
    const double B = shape.aspect(), c = (1 - shape.beta) / 2, a = (1 + shape.beta) / 2;  // over p0
    const auto material = material_of(clay(shape.M, shape.beta, 1e10));
    VectorX state = material->initial_state();
    Vector6 last = Vector6::Zero();
    for (int step = 0; step < 50; ++step)
      last = mixed_step(*material, state, strain_of(2e-4, 2e-4, -1e-3), {true, true, false},
                        Vector3::Zero(), 1e-8 * first_strength);
    const double A = 1 + 9 / (B * B), p = (c + std::sqrt(c * c - A * (c * c - a * a))) / A;
    const double r = 3 * p / (B * B * (p - c));
    EXPECT_NEAR(-state[2] / (3 * p * strength(eps_of(state))), 1.0, 1e-5) << shape.beta;
    EXPECT_NEAR(-last[0] / last[2], (r - 2.0 / 3) / (2 * r + 2.0 / 3), 1e-5) << shape.beta;
  }
}

/// First yield in uniaxial tension T: p = -T/3, q = T on y = 0.
TEST(CamClayClosedForm, UniaxialTensionIsTheClosedForm) {
  for (const Shape& shape : {Shape{1.2, 0.1}, Shape{3.3, 0.1}, Shape{3.3, 0.5}, Shape{3.1, 1}}) {
    const double E = 1e8, M2 = shape.M * shape.M, beta = shape.beta;
    const double k2 = 1 + 2 * beta + M2 / 9, k1 = M2 * (1 - beta) / 3, k0 = -M2 * beta;
    const double T = first_strength * (-k1 + std::sqrt(k1 * k1 - 4 * k2 * k0)) / (2 * k2);
    for (const double share : {1 - 1e-6, 1 + 1e-6}) {
      const auto material = material_of(clay(shape.M, beta, E, 0.0));
      VectorX state = material->initial_state();
      Branch branch{};
      material->update_point(stretch(strain_of(0, 0, share * T / E)), state, &branch);
      EXPECT_EQ(branch, share > 1 ? Branch::tension : Branch::elastic) << beta;
    }
  }
}

/// Stress and eps_vol_pl under the rate equations while the point flows: explicit Runge-Kutta of
/// fourth order, elastic rates minus those of associated flow with the consistency condition.
/// Nothing of src/material is used.
struct Rates {
  Shape shape;
  double K, G;
  using Vector7 = Eigen::Matrix<double, 7, 1>;

  Vector7 rate(const Vector7& y, const Vector6& strain) const {
    const Vector6 unit = strain_of(1, 1, 1), weights = (Vector6() << 1, 1, 1, 2, 2, 2).finished();
    const Vector6 stress = y.head<6>();
    const double p = -stress.head<3>().sum() / 3, p0 = strength(y[6]), B = shape.aspect();
    const double c = (1 - shape.beta) * p0 / 2, a = (1 + shape.beta) * p0 / 2;
    const Vector6 s = stress + p * unit;
    const double q = std::sqrt(1.5 * s.cwiseProduct(weights).dot(s));
    const double f_p = (p - c) / a, f_q = q / (B * B * a);
    const double f_eps = -growth * (c * f_p + a);  // dc/d(eps) = growth c
    const Vector6 flow = f_q * 1.5 / q * s - f_p / 3 * unit;
    const auto elastic = [&](const Vector6& e) -> Vector6 {
      const double trace = e.head<3>().sum();
      return K * trace * unit + 2 * G * (e - trace / 3 * unit);
    };
    const Vector6 image = elastic(flow).cwiseProduct(weights);
    const double multiplier = image.dot(strain) / (image.dot(flow) - f_eps * f_p);
    EXPECT_GT(multiplier, 0.0);
    Vector7 result;
    result << elastic(strain - multiplier * flow), multiplier * f_p;
    return result;
  }
};

/// From a point of the ellipse at p/p0 = share: sheared and pressed, or sheared and loosened, at a
/// turning rate. The update is of first order in the step: its error halves with the step, and two
/// step sizes extrapolated to zero agree with the reference to 1e-6.
TEST(CamClayRates, UpdateAgreesWithAnExplicitIntegration) {
  const double E = 1e6, nu = 0.2;
  for (const Shape& shape : {Shape{1.2, 0.1}, Shape{3.3, 0.1}, Shape{3.3, 0}}) {
    for (const double share : {0.9, 0.2}) {
      const auto material = material_of(clay(shape.M, shape.beta, E, nu));
      const double p = share * first_strength, c = (1 - shape.beta) / 2 * first_strength,
                   a = (1 + shape.beta) / 2 * first_strength;
      const double q = shape.aspect() * std::sqrt(a * a - (p - c) * (p - c));
      Rates::Vector7 y = Rates::Vector7::Zero();
      y.head<6>() = strain_of(-p + q / 3, -p + q / 3, -p - 2 * q / 3);
      VectorX start = material->initial_state();
      start.head<6>() = y.head<6>();
      const auto strain_rate = [&](double time) {
        return share > 0.5 ? strain_of(-0.05 * time, 0.02 * time, -0.1, 0.1 * time)
                           : strain_of(0.02, 0.02 + 0.01 * time, -0.02 * (1 - time), 0.05 * time);
      };
      const Rates rates{shape, E / (3 * (1 - 2 * nu)), E / (2 * (1 + nu))};
      constexpr int reference_steps = 4000;
      for (int i = 0; i < reference_steps; ++i) {
        const double h = 1.0 / reference_steps, time = i * h;
        const Rates::Vector7 k1 = rates.rate(y, strain_rate(time)),
                             k2 = rates.rate(y + 0.5 * h * k1, strain_rate(time + 0.5 * h)),
                             k3 = rates.rate(y + 0.5 * h * k2, strain_rate(time + 0.5 * h)),
                             k4 = rates.rate(y + h * k3, strain_rate(time + h));
        y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      }
      std::array<Rates::Vector7, 3> ends;
      for (std::size_t level = 0; level < ends.size(); ++level) {
        const int steps = 4000 << level;
        VectorX state = start;
        for (int i = 0; i < steps; ++i)
          material->update_point(stretch(strain_rate((i + 0.5) / steps) / steps), state);
        ends[level] << state.head<6>(), eps_of(state);
      }
      const double scale = y.head<6>().norm();
      const auto error = [&](const Rates::Vector7& end) {
        return ((end - y).head<6>() / scale).norm() + std::abs(end[6] - y[6]);
      };
      EXPECT_NEAR(error(ends[0]) / error(ends[1]), 2.0, 0.02) << shape.M << " " << share;
      EXPECT_LT(error(2 * ends[2] - ends[1]), 1e-6) << shape.M << " " << share;
      EXPECT_NEAR(law_of(*material).p0(y[6]) / strength(y[6]), 1.0, 1e-12);
    }
  }
}

}  // namespace
}  // namespace furrow::cohesive_cam_clay_test
