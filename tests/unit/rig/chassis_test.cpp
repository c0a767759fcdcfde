// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/rig/chassis.h"

#include <cmath>
#include <memory>
#include <numeric>
#include <tuple>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "tests/support/error_of.h"
#include "wheel_on_floor.h"

namespace furrow::chassis_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;

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
