// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/rig/sprung_body.h"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gmock/gmock.h>

namespace furrow::sprung_body_test {
namespace {

// ---- one strut: a quarter car

constexpr double sprung_mass = 50.0, spring = 8000.0;              // [kg], [N/m]
const double natural_frequency = std::sqrt(spring / sprung_mass);  // [rad/s]

/// Mass on one strut.
struct QuarterCar {
  /// @param damping [N s/m]
  QuarterCar(double mass, double stiffness, double damping) : body({mass, 0.0, 0.0}) {
    strut().stiffness = stiffness;
    strut().damping = damping;
  }
  Strut& strut() { return struts.front(); }
  /// Advances by a step under an axle height, its rate and a weight. @return height of the mass [m]
  double advance(double height, double velocity, double weight, double dt) {
    strut().height = height;
    strut().velocity = velocity;
    strut().weight = weight;
    body.advance(struts, Vector2::Zero(), dt);
    return body.position()[0];
  }

  SprungBody body;
  std::vector<Strut> struts{1};
};

double damping_of(double ratio) { return 2.0 * ratio * std::sqrt(spring * sprung_mass); }

// A weight W put on the mass over a held axle:
// s = -W/k (1 - exp(-z w t) (cos(w_d t) + z w/w_d sin(w_d t))).
TEST(SprungBody, QuarterCarOnAHeldAxleSwingsWithItsNaturalFrequencyAndDamping) {
  constexpr double dt = 1e-4, weight = 400.0;
  for (const double ratio : {0.0, 0.1, 0.4}) {
    QuarterCar car(sprung_mass, spring, damping_of(ratio));
    const double damped = natural_frequency * std::sqrt(1.0 - ratio * ratio);
    for (int i = 0; i < 20000; ++i) {
      const double height = car.advance(0.0, 0.0, weight, dt), t = (i + 1) * dt;
      const double decay = std::exp(-ratio * natural_frequency * t);
      const double expected =
          -weight / spring *
          (1.0 - decay * (std::cos(damped * t) +
                          ratio * natural_frequency / damped * std::sin(damped * t)));
      ASSERT_NEAR(height, expected, 2e-3 * weight / spring) << ratio << " " << t;
    }
  }
}

// A washboard moves the axle: the amplitude of the mass over that of the axle is
// sqrt((1 + (2 z r)^2)/((1 - r^2)^2 + (2 z r)^2)), r the frequency over the natural one.
TEST(SprungBody, QuarterCarOnAWashboardMovesByTheTransmissibility) {
  constexpr double dt = 1e-4, ratio = 0.25, amplitude = 0.01;
  for (const double r : {0.5, 1.0, 2.0}) {
    QuarterCar car(sprung_mass, spring, damping_of(ratio));
    const double w = r * natural_frequency;
    const int begin = 40000, end = begin + static_cast<int>(2.0 * pi / w / dt);
    double largest = 0.0;
    for (int i = 0; i < end; ++i) {
      const double t = i * dt;
      const double height = car.advance(amplitude * std::sin(w * t),
                                        amplitude * w * std::cos(w * (t - 0.5 * dt)), 0.0, dt);
      if (i >= begin) largest = std::max(largest, std::abs(height));
    }
    const double damper = std::pow(2.0 * ratio * r, 2);
    const double expected = std::sqrt((1.0 + damper) / (std::pow(1.0 - r * r, 2) + damper));
    EXPECT_NEAR(largest / amplitude, expected, 3e-3 * expected) << r;
  }
}

// ---- several struts

constexpr double stiffness = 6000.0;                 // of each spring [N/m]
constexpr double half_track = 0.5, half_base = 0.8;  // [m]
const Vector3 inertia(60.0, 9.0, 25.0);              // mass [kg], roll, pitch [kg m^2]
const Vector3 stiffnesses(4 * stiffness, 4 * stiffness * half_track * half_track,
                          4 * stiffness * half_base * half_base);

/// Four wheels at rest, without weight.
std::vector<Strut> four_struts(double damping) {
  std::vector<Strut> struts(4);
  for (std::size_t i = 0; i < 4; ++i) {
    struts[i].arm = {i < 2 ? half_base : -half_base, i % 2 == 0 ? half_track : -half_track};
    struts[i].stiffness = stiffness;
    struts[i].damping = damping;
  }
  return struts;
}

// A constant force Q on a coordinate of stiffness K over held axles:
// q = Q/K (1 - exp(-z w t) (cos(w_d t) + z w/w_d sin(w_d t))).
TEST(SprungBody, HeaveRollAndPitchSwingWithTheirNaturalFrequencyAndDamping) {
  constexpr double dt = 1e-4, damping = 120.0, force = 100.0;
  for (int k = 0; k < 3; ++k) {
    SprungBody body(inertia);
    std::vector<Strut> struts = four_struts(damping);
    if (k == 0)
      for (Strut& strut : struts) strut.weight = -force / 4;
    const Vector2 moment(k == 1 ? force : 0.0, k == 2 ? force : 0.0);
    const double frequency = std::sqrt(stiffnesses[k] / inertia[k]);
    const double ratio = 0.5 * damping / stiffness * frequency;
    const double damped = frequency * std::sqrt(1.0 - ratio * ratio);
    for (int i = 0; i < 10000; ++i) {
      body.advance(struts, moment, dt);
      const double t = (i + 1) * dt, decay = std::exp(-ratio * frequency * t);
      Vector3 expected = Vector3::Zero();
      expected[k] = force / stiffnesses[k] *
                    (1.0 - decay * (std::cos(damped * t) +
                                    ratio * frequency / damped * std::sin(damped * t)));
      ASSERT_LT((body.position() - expected).norm(), 3e-3 * force / stiffnesses[k])
          << k << " at " << t << " s";
    }
  }
}

// The inertia m a b about the centre of mass between the axles at a and -b makes the two axles
// centres of percussion of each other.
TEST(SprungBody, AxlesAtCentresOfPercussionMoveAsTwoQuarterCars) {
  constexpr double dt = 5e-4, front_mass = 35.0, rear_mass = 25.0, base = 1.6;
  const double total = front_mass + rear_mass, a = base * rear_mass / total, b = base - a;
  SprungBody body({total, 0.0, total * a * b});
  std::vector<Strut> struts(2);
  struts[0].arm = {a, 0.0};
  struts[1].arm = {-b, 0.0};
  QuarterCar front(front_mass, stiffness, 300.0), rear(rear_mass, stiffness, 200.0);
  struts[0].damping = 300.0;
  struts[1].damping = 200.0;
  for (Strut& strut : struts) strut.stiffness = stiffness;
  struts[0].weight = front_mass * standard_gravity;
  struts[1].weight = rear_mass * standard_gravity;
  for (int i = 0; i < 2000; ++i) {
    struts[0].height = 0.02 * std::sin(15.0 * i * dt);
    struts[0].velocity = 0.3 * std::cos(15.0 * (i - 0.5) * dt);
    body.advance(struts, Vector2::Zero(), dt);
    front.advance(struts[0].height, struts[0].velocity, struts[0].weight, dt);
    rear.advance(0.0, 0.0, struts[1].weight, dt);
    ASSERT_NEAR(struts[0].force, front.strut().force, 1e-8) << i;
    ASSERT_NEAR(struts[1].force, rear.strut().force, 1e-8) << i;
  }
}

double energy_error(double dt) {
  SprungBody body(inertia);
  std::vector<Strut> struts = four_struts(60.0);
  for (Strut& strut : struts) strut.weight = 0.25 * inertia[0] * standard_gravity;
  double largest = 0.0, flow = 0.0;
  for (int i = 0; i * dt < 2.0; ++i) {
    struts[1].height = 0.02 * std::sin(25.0 * i * dt);
    struts[1].velocity = 0.5 * std::cos(25.0 * (i - 0.5) * dt);
    body.advance(struts, Vector2(20.0, -30.0), dt);
    const SprungBody::Energy& e = body.energy();
    largest = std::max(largest, std::abs(e.kinetic + e.spring + e.damping_loss - e.weight_work -
                                         e.axle_work - e.moment_work));
    flow = e.damping_loss;
  }
  return largest / flow;
}

TEST(SprungBody, EnergyBalanceConvergesWithTheStep) {
  const double coarse = energy_error(1e-3), fine = energy_error(2.5e-4);
  EXPECT_LT(coarse, 0.1);
  EXPECT_GT(coarse / fine, 3.6);
}

/// Forces at rest with the front axle raised. @param pitch_inertia 0: held
std::vector<double> forces_on_step(double pitch_inertia, double step) {
  SprungBody body({60.0, 0.0, pitch_inertia});
  std::vector<Strut> struts(2);
  for (std::size_t i = 0; i < 2; ++i) {
    struts[i].arm = {i == 0 ? half_base : -half_base, 0.0};
    struts[i].stiffness = stiffness;
    struts[i].damping = 400.0;
    struts[i].weight = 30.0 * standard_gravity;
  }
  struts[0].height = step;
  for (int i = 0; i < 10000; ++i) body.advance(struts, Vector2::Zero(), 1e-3);
  return {struts[0].force, struts[1].force};
}

TEST(SprungBody, BogieOnAStepKeepsEqualLoadsAndAHeldBeamDoesNot) {
  constexpr double step = 0.03;
  const double share = 30.0 * standard_gravity;
  EXPECT_THAT(forces_on_step(20.0, step), testing::Each(testing::DoubleNear(share, 1e-9)));
  const std::vector<double> held = forces_on_step(0.0, step);
  EXPECT_NEAR(held[0], share + 0.5 * stiffness * step, 1e-9);
  EXPECT_NEAR(held[1], share - 0.5 * stiffness * step, 1e-9);
}

/// Forces of springs k at rest under weights W, axle heights h and moments m. They minimize the
/// complementary energy sum F^2/2k - F h under the three equations of equilibrium.
VectorX forces_by_statics(const std::vector<Strut>& struts, const Vector2& moment) {
  const auto n = static_cast<Eigen::Index>(struts.size());
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 3, n + 3);
  VectorX right = VectorX::Zero(n + 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Strut& strut = struts[static_cast<std::size_t>(i)];
    const Vector3 lever(1.0, strut.arm.y(), -strut.arm.x());
    system(i, i) = 1.0 / strut.stiffness;
    system.block<3, 1>(n, i) = lever;
    system.block<1, 3>(i, n) = lever.transpose();
    right[i] = strut.height;
    right.tail<3>() += strut.weight * lever;
  }
  right.tail<2>() -= moment;
  return system.fullPivLu().solve(right).head(n);
}

std::vector<Strut> struts_at(const std::vector<Vector2>& arms) {
  std::vector<Strut> struts(arms.size());
  for (std::size_t i = 0; i < arms.size(); ++i) {
    struts[i].arm = arms[i];
    struts[i].stiffness = stiffness * (1.0 + 0.4 * static_cast<double>(i));
    struts[i].weight = 100.0 + 40.0 * static_cast<double>(i);
    struts[i].damping = 400.0;
  }
  return struts;
}

const std::vector<Vector2> three_arms{{1.2, 0.1}, {-0.6, 0.5}, {-0.7, -0.4}};
const std::vector<Vector2> four_arms{{1.0, 0.5}, {1.1, -0.6}, {-0.9, 0.4}, {-0.8, -0.5}};

TEST(SprungBody, ThreeAndFourUnequalWheelsCarryTheWeightByStatics) {
  const Vector2 moment(30.0, -50.0);
  for (const auto& arms : {three_arms, four_arms}) {
    std::vector<Strut> struts = struts_at(arms);
    const VectorX level = forces_by_statics(struts, moment);
    struts[1].height = 0.02;
    const VectorX expected = forces_by_statics(struts, moment);
    // three wheels are statically determinate
    EXPECT_EQ((expected - level).norm() < 1e-9, arms.size() == 3);
    SprungBody body(inertia);
    for (int i = 0; i < 10000; ++i) body.advance(struts, moment, 1e-3);
    for (std::size_t i = 0; i < struts.size(); ++i)
      EXPECT_NEAR(struts[i].force, expected[static_cast<Eigen::Index>(i)], 1e-8) << i;
  }
}

// Axles raised by a mode shape: q = mode (1 - cos(w t)), K mode = w^2 M mode.
TEST(SprungBody, ModesOfThreeAndFourUnequalWheelsSwingWithTheirNaturalFrequency) {
  constexpr double dt = 1e-4;
  for (const auto& arms : {three_arms, four_arms}) {
    std::vector<Strut> struts = struts_at(arms);
    Matrix3 springs = Matrix3::Zero();
    for (Strut& strut : struts) {
      strut.damping = strut.weight = 0.0;
      const Vector3 lever(1.0, strut.arm.y(), -strut.arm.x());
      springs += strut.stiffness * lever * lever.transpose();
    }
    const Matrix3 masses = inertia.asDiagonal();
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix3> modes(springs, masses);
    for (int k = 0; k < 3; ++k) {
      const Vector3 mode = 0.01 * modes.eigenvectors().col(k);
      const double frequency = std::sqrt(modes.eigenvalues()[k]);
      for (Strut& strut : struts)
        strut.height = mode.dot(Vector3(1.0, strut.arm.y(), -strut.arm.x()));
      SprungBody body(inertia);
      for (int i = 0; i < 5000; ++i) {
        body.advance(struts, Vector2::Zero(), dt);
        const Vector3 expected = mode * (1.0 - std::cos(frequency * (i + 1) * dt));
        ASSERT_LT((body.position() - expected).norm(), 5e-3 * mode.norm()) << k << " " << i;
      }
    }
  }
}

}  // namespace
}  // namespace furrow::sprung_body_test
