// SPDX-License-Identifier: GPL-2.0-or-later
#include "rig/chassis.h"

#include <cmath>

#include <gmock/gmock.h>

#include "core/error.h"
#include "tests/support/error_of.h"
#include "wheel_on_floor.h"

namespace furrow {
namespace {

using test::error_of;
using ::testing::HasSubstr;
using Words = std::vector<std::string>;

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

// ---- with rigs and wheels

struct Pair {
  Pair(const Vector2& offset, const Words& rig_words, const Words& words) : offset_(offset) {
    for (std::size_t i = 0; i < 2; ++i) {
      const Vector2 place = (i == 0 ? 0.5 : -0.5) * offset;
      wheels[i].place({place.x(), place.y(), 0.2}, 0.0, 0.0);
      Words all{"load_mass",
                "15",
                "speed",
                "0.5",
                "load_ramp_time",
                "0.4",
                "settle_time",
                "1.5",
                "accelerate_time",
                "0.2",
                "ground_level",
                "0",
                "suspension_stiffness",
                "4000",
                "suspension_damping",
                "400"};
      all.insert(all.end(), rig_words.begin(), rig_words.end());
      rigs.push_back(
          std::make_unique<WheelRig>(WheelRig::schema("fix wheel/rig").read(all), wheels[i]));
    }
    Words all{"rigs", "a,b"};
    all.insert(all.end(), words.begin(), words.end());
    chassis = std::make_unique<Chassis>(Chassis::schema("fix wheel/chassis").read(all),
                                        std::vector<WheelRig*>{rigs[0].get(), rigs[1].get()});
  }
  /// Means of the last 0.1 s.
  void run(double end) {
    const long steps = std::lround(end / dt);
    for (long i = 0; i < steps; ++i) {
      for (auto& rig : rigs) rig->apply(i * dt, dt);
      chassis->apply(i * dt, dt);
      for (std::size_t k = 0; k < 2; ++k) {
        wheels[k].advance(dt);
        floor.press_on(wheels[k].surface());
        if (steps - i > std::lround(0.1 / dt)) continue;
        const double share = dt / 0.1;
        loads[k] += share * wheels[k].ground_wrench().force.z();
        torque += share * wheels[k].constraint(Coordinate::spin);
        guide += share * wheels[k].constraint(Coordinate::x);
      }
    }
  }
  static constexpr double dt = 2e-4;
  Vector2 offset_;
  RigidWheel wheels[2] = {make_wheel(0.2, 160), make_wheel(0.2, 160)};
  std::vector<std::unique_ptr<WheelRig>> rigs;
  std::unique_ptr<Chassis> chassis;
  Floor floor{3e4, 0.8, 1e-2};
  double loads[2] = {0.0, 0.0}, torque = 0.0, guide = 0.0;  // [N], [N m], [N]
};

constexpr double sprung = 24.0, wheel = 3.0, radius = 0.2;  // [kg] both shares, [kg], [m]

// Guides at the height of the ground stand for the lateral force of the ground: the weights turn
// the vehicle about its track.
TEST(Chassis, SideSlopeShiftsTheLoadByStatics) {
  constexpr double track = 1.0, height = 0.3, slope = 10.0;
  for (const double guide : {0.0, -radius}) {
    Pair axle({0.0, track}, {"mode", "towed", "side_slope", "10", "damping", "300"},
              {"roll_inertia", "6", "height", "0.3", "guide_height", std::to_string(guide)});
    axle.run(1.5);
    const double down = standard_gravity * std::cos(radians(slope));
    const double across = standard_gravity * std::sin(radians(slope));
    const double moment = across * (sprung * (height - guide) - 2.0 * wheel * guide);
    EXPECT_NEAR(axle.loads[0] + axle.loads[1], (sprung + 2.0 * wheel) * down, 1e-4);
    EXPECT_NEAR(axle.loads[1] - axle.loads[0], 2.0 * moment / track, 1e-4) << guide;
    const double floor = (axle.wheels[0].centre().z() - axle.wheels[1].centre().z()) / track;
    EXPECT_NEAR(axle.chassis->body().position()[1], floor + moment / (0.5 * 4000.0 * track * track),
                1e-6);
  }
}

// Torques that carry the weight up the slope: the load shifts to the rear by the height of the
// weights above the ground.
TEST(Chassis, GradeShiftsTheLoadByStatics) {
  constexpr double base = 1.2, height = 0.25, slope = 8.0;
  const double along = standard_gravity * std::sin(radians(slope));
  const double weight = (sprung + 2.0 * wheel) * along;
  Pair bogie({base, 0.0},
             {"mode", "torque", "torque", std::to_string(0.5 * radius * weight), "slope", "8"},
             {"pitch_inertia", "8", "height", "0.25"});
  bogie.run(2.5);
  EXPECT_NEAR(bogie.guide, 0.0, 0.02 * weight);
  EXPECT_NEAR(bogie.torque, radius * weight, 1e-6);
  const double moment = sprung * along * height + radius * weight;
  EXPECT_NEAR(bogie.loads[1] - bogie.loads[0], 2.0 * moment / base, 0.005 * moment);
}

TEST(Chassis, RefusesWheelsThatDoNotSupportItAndMissingInertia) {
  const auto refusal = [](const Vector2& offset, const Words& rig, const Words& words) {
    return error_of<InputError>([&] { Pair(offset, rig, words); });
  };
  const Words towed{"mode", "towed"};
  EXPECT_THAT(refusal({0.0, 1.0}, towed, {}),
              HasSubstr("keyword 'roll_inertia' is missing, and the wheels are 1 m apart along y"));
  EXPECT_THAT(refusal({0.0, 1.0}, towed, {"roll_inertia", "1", "pitch_inertia", "1"}),
              HasSubstr("keyword 'pitch_inertia' is given, and all wheels have the same x"));
  EXPECT_THAT(refusal({1.0, 1.0}, towed, {"roll_inertia", "1", "pitch_inertia", "1"}),
              HasSubstr("has wheels that do not support the body in roll and pitch"));
  Pair pair({0.0, 1.0}, towed, {"roll_inertia", "1"});
  const auto second = [&] {
    Chassis(Chassis::schema("fix wheel/chassis").read(Words{"rigs", "a,b", "roll_inertia", "1"}),
            {pair.rigs[0].get(), pair.rigs[1].get()});
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
}  // namespace furrow
