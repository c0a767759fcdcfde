// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/bodies/rigid_wheel.h"

#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "tests/support/checkpoints.h"
#include "tests/support/error_of.h"
#include "tests/support/words.h"

namespace furrow::rigid_wheel_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;

RigidWheelParameters small_wheel() {
  RigidWheelParameters wheel;
  wheel.geometry.diameter = 0.4;
  wheel.geometry.width = 0.1;
  wheel.geometry.segments = 12;
  wheel.hub = {{3.0, 0.06, 0.04}, {0.1, -0.2, 0.5}};
  return wheel;
}

std::string refusal_of(const std::string& line) {
  const std::vector<std::string> words =
      test::words(line, "diameter 0.74 width 0.272 mass 636 inertia 2.15");
  return error_of<InputError>(
      [&] { RigidWheel wheel(RigidWheel::schema("fix wheel/rigid").read(words)); });
}

constexpr std::array<Coordinate, 6> all_coordinates{Coordinate::x,   Coordinate::y,
                                                    Coordinate::z,   Coordinate::spin,
                                                    Coordinate::yaw, Coordinate::camber};

TEST(RigidWheel, ReadsItsKeys) {
  const RigidWheel wheel(RigidWheel::schema().read(
      test::words("diameter 0.74 width 0.272 shoulder 0.051 mass 636 inertia 2.15 axle 1 2 3")));
  EXPECT_DOUBLE_EQ(wheel.parameters().hub.inertia.mass, 636.0);
  EXPECT_DOUBLE_EQ(wheel.parameters().hub.inertia.axial, 2.15);
  EXPECT_DOUBLE_EQ(wheel.parameters().hub.inertia.diametral,
                   0.5 * 2.15 + 636.0 * 0.272 * 0.272 / 12.0);
  EXPECT_EQ(wheel.centre(), Vector3(1, 2, 3));
  EXPECT_DOUBLE_EQ(wheel.lowest_point(), 3.0 - 0.37);
  EXPECT_TRUE(wheel.surface().is_closed());
  EXPECT_EQ(wheel.stable_time_step(), std::numeric_limits<double>::infinity());
  for (const auto coordinate : all_coordinates)
    EXPECT_EQ(wheel.motion(coordinate), RigidWheel::Motion::held);
}

TEST(RigidWheel, RefusesWithKeywordAndRemedy) {
  EXPECT_THAT(refusal_of("mass -5"),
              HasSubstr("fix wheel/rigid, keyword 'mass' is -5; allowed: a number > 0 [kg]"));
  EXPECT_THAT(refusal_of("inertia 88"),
              HasSubstr("keyword 'inertia' is 88 kg m^2; allowed: at most 87.0684 kg m^2"));
  EXPECT_THAT(refusal_of("inertia_diametral 1"),
              HasSubstr("keyword 'inertia_diametral' is 1 kg m^2; allowed: at least half of"));
  EXPECT_THAT(refusal_of("shoulder 0.2"), HasSubstr("has shoulder 0.2 m"));
  EXPECT_THAT(refusal_of("grousers 6"),
              HasSubstr("keyword 'grouser_height' is missing; allowed: a number > 0 [m]"));
  EXPECT_THAT(refusal_of("grousers 6 grouser_height 0.02"),
              HasSubstr("keyword 'grouser_thickness' is missing"));
  EXPECT_THAT(refusal_of("grouser_height 0.02"),
              HasSubstr("keyword 'grouser_height' is given to a wheel without grousers"));
  EXPECT_THAT(refusal_of("segments 8"),
              HasSubstr("keyword 'segments' is 8; allowed: an integer in [12, 5000]"));
}

TEST(RigidWheel, RefusesParametersThatAreNotNumbers) {
  RigidWheelParameters wheel = small_wheel();
  wheel.hub.inertia.mass = std::nan("");
  EXPECT_THAT(error_of([&] { RigidWheel{wheel}; }),
              HasSubstr("rigid wheel, keyword 'mass' is nan; allowed: a number > 0 [kg]"));
  wheel = small_wheel();
  wheel.hub.centre.x() = std::nan("");
  EXPECT_THAT(error_of([&] { RigidWheel{wheel}; }), HasSubstr("keyword 'axle' is not finite"));
}

TEST(RigidWheel, FreeFallFollowsTheLeapfrogExactly) {
  RigidWheel wheel(small_wheel());
  wheel.release(Coordinate::z);
  const double g = standard_gravity, dt = 1e-3;
  wheel.set_load({0, 0, -3.0 * g});
  for (int i = 0; i < 1000; ++i) wheel.advance(dt);
  // sum of i dt g dt; g t^2/2 within dt t g/2
  EXPECT_NEAR(wheel.centre().z(), 0.5 - g * dt * dt * 1000 * 1001 / 2, 1e-12);
  EXPECT_NEAR(wheel.velocity().z(), -g, 1e-12);
  EXPECT_EQ(wheel.centre().x(), 0.1);
  EXPECT_NEAR(wheel.energy_budget().load_work / wheel.energy_budget().kinetic_energy, 1.0, 1e-13);
}

TEST(RigidWheel, SpinAccelerationIsTorqueOverInertia) {
  RigidWheel wheel(small_wheel());
  wheel.release(Coordinate::spin);
  wheel.set_axle_torque(0.3);
  const double dt = 1e-3;
  for (int i = 0; i < 1000; ++i) wheel.advance(dt);
  EXPECT_NEAR(wheel.rate(Coordinate::spin), 0.3 / 0.06, 1e-12);
  EXPECT_NEAR(wheel.position(Coordinate::spin), 0.3 / 0.06 * dt * dt * 1000 * 1001 / 2, 1e-12);
  EXPECT_DOUBLE_EQ(wheel.constraint(Coordinate::spin), 0.3);
  EXPECT_NEAR(wheel.energy_budget().drive_work, 0.5 * 0.06 * 25.0, 1e-12);
}

TEST(RigidWheel, PositiveSpinRollsForward) {
  RigidWheel wheel(small_wheel());
  wheel.prescribe(Coordinate::spin, 2.0);
  wheel.prescribe(Coordinate::x, 0.4);  // omega r
  wheel.advance(1e-3);
  const Surface& surface = wheel.surface();
  for (Eigen::Index node = 0; node < surface.x.cols(); ++node) {
    const Vector3 arm = surface.x.col(node) - wheel.centre();
    EXPECT_NEAR((surface.v.col(node) - Vector3(0.4 + 2.0 * arm.z(), 0.0, -2.0 * arm.x())).norm(),
                0.0, 1e-14);
  }
}

TEST(RigidWheel, HeldWheelReportsItsConstraintForces) {
  RigidWheel wheel(small_wheel());
  wheel.set_load({0, 0, -30.0});
  const Vector3 force(1.0, -2.0, 50.0);
  wheel.surface().f.col(wheel.surface().triangles[0][0]) += force;
  const Vector3 moment = wheel.surface().total_moment(wheel.centre());
  wheel.advance(1e-4);
  EXPECT_NEAR(wheel.constraint(Coordinate::x), -1.0, 1e-13);
  EXPECT_NEAR(wheel.constraint(Coordinate::y), 2.0, 1e-13);
  EXPECT_NEAR(wheel.constraint(Coordinate::z), -20.0, 1e-13);
  EXPECT_NEAR(wheel.constraint(Coordinate::spin), -moment.y(), 1e-12);
  EXPECT_NEAR(wheel.constraint(Coordinate::yaw), -moment.z(), 1e-12);
  EXPECT_NEAR(wheel.constraint(Coordinate::camber), -moment.x(), 1e-12);
  EXPECT_EQ(wheel.energy_budget().drive_work, 0.0);
  EXPECT_EQ(wheel.centre(), small_wheel().hub.centre);
}

TEST(RigidWheel, PrescribedSpinReportsItsTorque) {
  RigidWheel wheel(small_wheel());
  const double dt = 1e-3, alpha = 7.0;
  for (int i = 1; i <= 100; ++i) {
    wheel.prescribe(Coordinate::spin, alpha * i * dt);
    wheel.advance(dt);
    EXPECT_NEAR(wheel.constraint(Coordinate::spin), 0.06 * alpha, 1e-10);
  }
}

TEST(RigidWheel, NodesKeepTheShapeAfterManyTurns) {
  RigidWheel wheel(small_wheel());
  const Matrix3X start = wheel.surface().x;
  wheel.prescribe(Coordinate::spin, 2.0 * pi * 100);  // 100 turns a second
  for (int i = 0; i < 100000; ++i) wheel.advance(1e-4);
  EXPECT_NEAR(wheel.position(Coordinate::spin), 2.0 * pi * 1000, 1e-6);
  wheel.place(wheel.centre(), 0.0, 0.0);
  EXPECT_EQ((wheel.surface().x - start).norm(), 0.0);
}

// Steady precession: a couple M about the level line across the axle turns the axle at -M/(C
// d(spin)/dt) about the vertical.
TEST(RigidWheel, FastWheelPrecessesUnderACouple) {
  RigidWheel wheel(small_wheel());
  for (const auto angle : {Coordinate::spin, Coordinate::yaw, Coordinate::camber})
    wheel.release(angle);
  const double omega = 1000.0, couple = 3.0, dt = 1e-6, precession = -couple / (0.06 * omega);
  wheel.set_velocity(Vector3::Zero(), {omega, precession, 0.0});
  const int steps = 20000;
  for (int i = 0; i < steps; ++i) {
    // forces level x arm on all nodes of the ring-symmetric mesh: no resultant, a pure couple along
    // level
    Surface& surface = wheel.surface();
    const Vector3 level(std::cos(wheel.position(Coordinate::yaw)),
                        std::sin(wheel.position(Coordinate::yaw)), 0.0);
    for (Eigen::Index node = 0; node < surface.x.cols(); ++node)
      surface.f.col(node) = level.cross(Vector3(surface.x.col(node) - wheel.centre()));
    surface.f *= couple / surface.total_moment(wheel.centre()).dot(level);
    wheel.advance(dt);
  }
  EXPECT_NEAR(wheel.position(Coordinate::yaw) / (precession * steps * dt), 1.0, 1e-9);
  EXPECT_NEAR(wheel.position(Coordinate::camber), 0.0, 1e-9);
}

// A body of revolution left to itself keeps its angular momentum; the error falls with the square
// of the step.
TEST(RigidWheel, FreeRotationKeepsEnergyToRoundOffAndAngularMomentumToSecondOrder) {
  std::array<double, 3> error{};
  for (std::size_t level = 0; level < 3; ++level) {
    RigidWheel wheel(small_wheel());
    for (const auto angle : {Coordinate::spin, Coordinate::yaw, Coordinate::camber})
      wheel.release(angle);
    wheel.set_velocity(Vector3::Zero(), {20.0, 3.0, -2.0});
    const double energy = wheel.energy_budget().kinetic_energy, dt = 5e-4 / (1 << level);
    // half-way through a step, where the velocities belong
    const auto step = [&] {
      const Vector3 before = wheel.axle();
      wheel.advance(dt);
      const Vector3 a = (before + wheel.axle()).normalized(), omega = wheel.angular_velocity();
      return Vector3(0.04 * omega + (0.06 - 0.04) * omega.dot(a) * a);
    };
    const Vector3 start = step();
    Vector3 momentum = start;
    for (int i = 0; i < 4000 << level; ++i) momentum = step();  // 2 s, six turns
    error[level] = (momentum - start).norm() / start.norm();
    EXPECT_NEAR(wheel.energy_budget().kinetic_energy / energy, 1.0, 1e-12);
  }
  EXPECT_LT(error[0], 1e-5);
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2.0, 0.05);
  EXPECT_NEAR(std::log2(error[1] / error[2]), 2.0, 0.05);
}

/// Random forces over 1e5 steps; every work is counted, so that the balance closes to round-off in
/// all modes.
void expect_closed_balance(const std::array<RigidWheel::Motion, 6>& motions) {
  RigidWheel wheel(small_wheel());
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (std::size_t i = 0; i < 6; ++i)
    if (motions[i] == RigidWheel::Motion::free) wheel.release(all_coordinates[i]);
  wheel.set_vertical_damping(2.0);
  wheel.set_velocity({0.3, -0.1, 0.2}, {4.0, 0.5, -0.3});
  const double start = wheel.energy_budget().residual();
  double scale = 0.0, work = 0.0;
  for (int step = 0; step < 100000; ++step) {
    for (std::size_t i = 0; i < 6; ++i)
      if (motions[i] == RigidWheel::Motion::prescribed)
        wheel.prescribe(all_coordinates[i], 0.5 * std::sin(1e-2 * step + static_cast<double>(i)));
    wheel.surface().clear_forces();
    const auto triangle = static_cast<std::size_t>(random() % wheel.surface().triangle_count());
    wheel.surface().f.col(wheel.surface().triangles[triangle][0]) +=
        Vector3{normal(random), normal(random), normal(random)};
    wheel.set_load({normal(random), normal(random), normal(random)});
    wheel.set_axle_torque(normal(random));
    const double before = work;
    wheel.advance(1e-4);
    const EnergyBudget budget = wheel.energy_budget();
    work = budget.contact_work + budget.load_work + budget.drive_work;
    scale += std::abs(work - before) + budget.kinetic_energy * 1e-3;
  }
  EXPECT_NEAR(wheel.energy_budget().residual(), start, 1e-13 * std::max(scale, 1.0));
  EXPECT_GT(scale, 0.1);
}

constexpr auto F = RigidWheel::Motion::free, H = RigidWheel::Motion::held,
               P = RigidWheel::Motion::prescribed;

TEST(RigidWheel, BalanceClosesWithEveryCoordinateFree) {
  expect_closed_balance({F, F, F, F, F, H});
}
TEST(RigidWheel, BalanceClosesWithCamberFree) { expect_closed_balance({F, F, F, F, F, F}); }
TEST(RigidWheel, BalanceClosesWithEveryCoordinatePrescribed) {
  expect_closed_balance({P, P, P, P, P, P});
}
TEST(RigidWheel, BalanceClosesTowed) { expect_closed_balance({P, H, F, F, H, H}); }
TEST(RigidWheel, BalanceClosesWithSlipPrescribed) { expect_closed_balance({P, H, F, P, H, H}); }
TEST(RigidWheel, BalanceClosesWithFreeSpinInATurn) { expect_closed_balance({P, P, F, F, P, P}); }
TEST(RigidWheel, BalanceClosesWithOnlyYawFree) { expect_closed_balance({H, H, H, P, F, P}); }

TEST(RigidWheel, VerticalDampingDissipatesTheLostEnergy) {
  RigidWheel wheel(small_wheel());
  wheel.release(Coordinate::z);
  wheel.set_velocity({0, 0, 1.0}, Vector3::Zero());
  wheel.set_vertical_damping(6.0);  // rate c/m = 2/s
  for (int i = 0; i < 1000; ++i) wheel.advance(1e-3);
  EXPECT_NEAR(wheel.velocity().z(), std::exp(-2.0), 1e-7);
  EXPECT_NEAR(wheel.energy_budget().dissipated_energy, 1.5 * (1.0 - std::exp(-4.0)), 1e-6);
  EXPECT_THAT(error_of([&] { wheel.set_vertical_damping(-1.0); }),
              HasSubstr("vertical damping is -1 N s/m; allowed: a number >= 0"));
}

TEST(RigidWheel, ContinuesBitwiseFromItsState) {
  RigidWheel one(small_wheel()), other(small_wheel());
  const auto step = [](RigidWheel& wheel, int i) {
    wheel.surface().f.setConstant(0.01 * std::sin(0.1 * i));
    wheel.advance(1e-3);
  };
  for (const auto coordinate : {Coordinate::z, Coordinate::spin, Coordinate::camber})
    one.release(coordinate);
  one.prescribe(Coordinate::x, 0.7);
  one.set_load({0, 0, -2.0});
  one.set_axle_torque(0.1);
  for (int i = 0; i < 100; ++i) step(one, i);
  test::hand_over(one, other);
  EXPECT_EQ(one.surface().x, other.surface().x);
  EXPECT_EQ(one.surface().v, other.surface().v);
  for (int i = 100; i < 200; ++i) {
    step(one, i);
    step(other, i);
  }
  EXPECT_EQ(test::state_of(one), test::state_of(other));
  EXPECT_EQ(one.surface().x, other.surface().x);
}

TEST(RigidWheel, RefusesTheStateOfAnotherWheel) {
  RigidWheelParameters heavier = small_wheel();
  heavier.hub.inertia.mass = 4.0;
  RigidWheel wheel(small_wheel()), other(heavier);
  EXPECT_THAT(error_of([&] { test::hand_over(other, wheel); }),
              HasSubstr("and was 4 when the checkpoint was written"));
}

TEST(RigidWheel, NonFiniteStatesAndStepsStopTheRun) {
  RigidWheel wheel(small_wheel());
  EXPECT_THAT(error_of([&] { wheel.advance(0.0); }), HasSubstr("a step of 0 s"));
  EXPECT_THAT(error_of([&] { wheel.prescribe(Coordinate::x, std::nan("")); }),
              HasSubstr("prescribed velocity is nan"));
  EXPECT_THAT(error_of([&] {
                wheel.set_velocity({0, 0, std::nan("")}, Vector3::Zero());
              }),
              HasSubstr("is not finite"));
  EXPECT_THAT(error_of([&] { wheel.place({0, 0, 0}, 0.0, 1.55); }), HasSubstr("cannot be placed"));
  wheel.surface().f(2, 5) = std::nan("");
  EXPECT_THAT(error_of([&] { wheel.advance(1e-3); }),
              HasSubstr("rigid wheel: not finite: force 0 0 nan N"));
  wheel.surface().clear_forces();
  wheel.prescribe(Coordinate::camber, 2000.0);
  EXPECT_THAT(error_of([&] { wheel.advance(1e-3); }),
              HasSubstr("fell over, its camber is 114.6 degrees"));
}

}  // namespace
}  // namespace furrow::rigid_wheel_test
