// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/rig/chassis.h"

#include <cmath>
#include <memory>
#include <numeric>
#include <tuple>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "tests/support/error_of.h"
#include "wheel_on_floor.h"

namespace furrow::chassis_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;

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
  Suspension front(stiffness, 300.0, front_mass), rear(stiffness, 200.0, rear_mass);
  struts[0].damping = 300.0;
  struts[1].damping = 200.0;
  for (Strut& strut : struts) strut.stiffness = stiffness;
  struts[0].weight = front_mass * standard_gravity;
  struts[1].weight = rear_mass * standard_gravity;
  for (int i = 0; i < 2000; ++i) {
    struts[0].height = 0.02 * std::sin(15.0 * i * dt);
    struts[0].velocity = 0.3 * std::cos(15.0 * (i - 0.5) * dt);
    body.advance(struts, Vector2::Zero(), dt);
    const double front_force =
        front.advance(struts[0].height, struts[0].velocity, struts[0].weight, dt);
    const double rear_force = rear.advance(0.0, 0.0, struts[1].weight, dt);
    ASSERT_NEAR(struts[0].force, front_force, 1e-8) << i;
    ASSERT_NEAR(struts[1].force, rear_force, 1e-8) << i;
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

// ---- with rigs and wheels

Options chassis_options(const std::string& line) {
  return Chassis::schema("fix wheel/chassis").read(test::words("rigs a,b " + line));
}

struct Vehicle {
  /// @param rig keywords of all rigs @param line of the chassis
  Vehicle(std::vector<Vector2> at, const std::string& rig, const std::string& line,
          const std::string& travel = "speed 0.5")
      : places(std::move(at)), loads(places.size(), 0.0) {
    std::vector<WheelRig*> all_rigs;
    for (const Vector2& place : places) {
      wheels.push_back(std::make_unique<RigidWheel>(make_wheel(0.2, 160)));
      wheels.back()->place({place.x(), place.y(), 0.2}, 0.0, 0.0);
      rigs.push_back(std::make_unique<WheelRig>(
          rig_of(*wheels.back(),
                 "load_mass 15 load_ramp_time 0.4 settle_time 1.5 accelerate_time 0.2 "
                 "ground_level 0 suspension_stiffness 4000 suspension_damping 400 " +
                     travel + " " + rig)));
      all_rigs.push_back(rigs.back().get());
    }
    chassis = std::make_unique<Chassis>(chassis_options(line), all_rigs);
  }
  /// Means of the last 0.1 s.
  void run(double end) {
    const long steps = std::lround(end / dt);
    for (long i = 0; i < steps; ++i) {
      for (auto& rig : rigs) rig->apply(i * dt, dt);
      chassis->apply(i * dt, dt);
      for (std::size_t k = 0; k < wheels.size(); ++k) {
        wheels[k]->advance(dt);
        floor.press_on(wheels[k]->surface());
        if (i * dt > 1.5) push += dt * wheels[k]->ground_wrench().force.x();
        if (steps - i > std::lround(0.1 / dt)) continue;
        const double share = dt / 0.1;
        loads[k] += share * wheels[k]->ground_wrench().force.z();
        torque += share * wheels[k]->constraint(Coordinate::spin);
        guide += share * wheels[k]->constraint(Coordinate::x);
      }
    }
  }
  double mass() const { return 15.0 * static_cast<double>(places.size()); }  ///< of all [kg]
  double load() const { return std::accumulate(loads.begin(), loads.end(), 0.0); }
  double sprung() const { return 12.0 * static_cast<double>(places.size()); }

  static constexpr double dt = 2e-4;
  std::vector<Vector2> places;
  std::vector<std::unique_ptr<RigidWheel>> wheels;
  std::vector<std::unique_ptr<WheelRig>> rigs;
  std::unique_ptr<Chassis> chassis;
  Floor floor{3e4, 0.8, 1e-2};
  std::vector<double> loads;         // [N]
  double torque = 0.0, guide = 0.0;  // [N m], [N]
  double push = 0.0;                 // impulse of the floor along x since the wheels settled [N s]
};

constexpr double base = 1.2, track = 1.0, radius = 0.2;  // [m]
using Places = std::vector<Vector2>;
// About their centre; without products of x and y
const Places axle{{0.0, 0.5 * track}, {0.0, -0.5 * track}};
const Places bogie{{0.5 * base, 0.0}, {-0.5 * base, 0.0}};
const Places tricycle{
    {base * 2.0 / 3.0, 0.0}, {-base / 3.0, 0.5 * track}, {-base / 3.0, -0.5 * track}};
const Places two_axles{{0.5 * base, 0.5 * track},
                       {0.5 * base, -0.5 * track},
                       {-0.5 * base, 0.5 * track},
                       {-0.5 * base, -0.5 * track}};

/// A moment M shifts the load of wheel i by -M a_i/sum a^2 over the arms a.
void expect_shifted(const Vehicle& vehicle, int along, double moment, double tolerance) {
  double arms = 0.0;
  for (const Vector2& place : vehicle.places) arms += place[along] * place[along];
  const double share = vehicle.load() / static_cast<double>(vehicle.places.size());
  for (std::size_t k = 0; k < vehicle.places.size(); ++k)
    EXPECT_NEAR(vehicle.loads[k], share - moment * vehicle.places[k][along] / arms, tolerance)
        << "wheel " << k << " of " << vehicle.places.size();
}

// Guides at the height of the ground stand for the lateral force of the ground: the weights turn
// the vehicle about its track.
TEST(Chassis, SideSlopeShiftsTheLoadByStatics) {
  constexpr double height = 0.3, slope = 10.0;
  using Case = std::tuple<Places, std::string, double>;
  for (const auto& [places, pitch, guide] :
       {Case{axle, "", 0.0}, Case{tricycle, "pitch_inertia 9", -radius},
        Case{two_axles, "pitch_inertia 16", 0.0}}) {
    Vehicle vehicle(places, "mode towed side_slope 10 damping 300",
                    fmt::format("roll_inertia 6 height 0.3 guide_height {} {}", guide, pitch));
    vehicle.run(1.5);
    const double down = standard_gravity * std::cos(radians(slope));
    const double across = standard_gravity * std::sin(radians(slope));
    const double moment = across * (vehicle.sprung() * (height - guide) -
                                    (vehicle.mass() - vehicle.sprung()) * guide);
    EXPECT_NEAR(vehicle.load(), vehicle.mass() * down, 1e-4);
    expect_shifted(vehicle, 1, moment, 1e-4);
    Vector2 arms = Vector2::Zero(), floor = Vector2::Zero();
    for (std::size_t k = 0; k < places.size(); ++k) {
      arms += places[k].cwiseAbs2();
      floor += places[k] * vehicle.wheels[k]->centre().z();
    }
    const Vector3& turned = vehicle.chassis->body().position();
    EXPECT_NEAR(turned[1], (floor.y() + moment / 4000.0) / arms.y(), 1e-6);
    EXPECT_NEAR(turned[2], arms.x() > 0.0 ? -floor.x() / arms.x() : 0.0, 1e-9);
  }
}

// Torques that carry the weight up the slope: the load shifts to the rear by the height of the
// weights above the ground.
TEST(Chassis, GradeShiftsTheLoadByStatics) {
  constexpr double height = 0.25, slope = 8.0;
  const double along = standard_gravity * std::sin(radians(slope));
  for (const auto& [places, roll] : {std::pair{bogie, ""}, {two_axles, "roll_inertia 12"}}) {
    const double count = static_cast<double>(places.size()), weight = 15.0 * count * along;
    Vehicle vehicle(places, fmt::format("mode torque torque {} slope 8", radius * weight / count),
                    std::string("pitch_inertia 8 height 0.25 ") + roll);
    vehicle.run(2.5);
    EXPECT_NEAR(vehicle.guide, 0.0, 0.02 * weight);
    EXPECT_NEAR(vehicle.torque, radius * weight, 1e-5);
    const double moment = vehicle.sprung() * along * height + radius * weight;
    expect_shifted(vehicle, 0, moment, 0.005 * moment);
    EXPECT_NEAR(vehicle.chassis->body().position()[1], 0.0, 1e-9);
  }
}

// Both wheels slide while they accelerate, and the rear one bears more: alone it would leave the
// front.
TEST(Chassis, AxlesThatTravelFreelyMoveAsOneUnderTheSumOfTheirForces) {
  constexpr double slope = 8.0, end = 2.0, settled = 1.5;
  Vehicle vehicle(bogie, "mode spin spin_rate 20 slope 8", "pitch_inertia 8 height 0.25",
                  "travel free");
  vehicle.run(end);
  const double weight = vehicle.mass() * standard_gravity * std::sin(radians(slope));
  const double speed = (vehicle.push - weight * (end - settled)) / vehicle.mass();
  ASSERT_GT(speed, 1.0);
  EXPECT_GT(vehicle.loads[1] - vehicle.loads[0], 0.1 * vehicle.load());
  for (const auto& wheel : vehicle.wheels)
    EXPECT_NEAR(wheel->rate(Coordinate::x), speed, 0.005 * speed);
  EXPECT_NEAR(vehicle.wheels[0]->centre().x() - vehicle.wheels[1]->centre().x(), base, 1e-6);
}

TEST(Chassis, RefusesWheelsThatDoNotSupportItAndMissingInertia) {
  const auto refusal = [](const Vector2& offset, const std::string& line) {
    return error_of<InputError>([&] {
      Vehicle({0.5 * offset, -0.5 * offset}, "mode towed", line);
    });
  };
  EXPECT_THAT(refusal({0.0, 1.0}, ""),
              HasSubstr("keyword 'roll_inertia' is missing, and the wheels are 1 m apart along y"));
  EXPECT_THAT(refusal({0.0, 1.0}, "roll_inertia 1 pitch_inertia 1"),
              HasSubstr("keyword 'pitch_inertia' is given, and all wheels have the same x"));
  EXPECT_THAT(refusal({1.0, 1.0}, "roll_inertia 1 pitch_inertia 1"),
              HasSubstr("has wheels that do not support the body in roll and pitch"));
  Vehicle pair(axle, "mode towed", "roll_inertia 1");
  const auto second = [&] {
    Chassis(chassis_options("roll_inertia 1"), {pair.rigs[0].get(), pair.rigs[1].get()});
  };
  EXPECT_THAT(error_of<InputError>(second), HasSubstr("carries a chassis already"));
  EXPECT_THAT(error_of<StateError>([&] {
                SprungBody body({1.0, 0.0, 0.0});
                std::vector<Strut> struts(1);
                struts[0].stiffness = 1e6;
                body.advance(struts, Vector2::Zero(), 1e-3);
              }),
              HasSubstr("a step of 0.001 s is too long for the springs in heave"));
}

}  // namespace
}  // namespace furrow::chassis_test
