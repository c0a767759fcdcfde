// SPDX-License-Identifier: GPL-2.0-or-later
// A rigid wheel at a given sinkage on a height field, against the closed form of Bekker's towed
// wheel and the integrals of Wong and Reece's driven wheel, as the cells become smaller.

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "furrow/bodies/coupled_system.h"
#include "furrow/bodies/rigid_wheel.h"
#include "furrow/scm/scm_contact.h"

namespace furrow::scm_wheel_test {
namespace {

constexpr double radius = 0.25, width = 0.1, sinkage = 0.03, speed = 1.0;

Soil sand() {
  Soil soil;
  soil.k_c = 1.0e4;
  soil.k_phi = 1.2e6;
  soil.n = 0.9;
  soil.cohesion = 1e3;
  soil.friction_angle = radians(31.0);
  soil.shear_length = 0.015;
  soil.stiffness = 1e13;  // nearly no rebound behind the wheel, as in the closed forms
  return soil;
}

Soil without_shear() {
  Soil soil = sand();
  soil.cohesion = soil.friction_angle = 0.0;
  return soil;
}

RigidWheelParameters wheel_at(double z, int segments) {
  RigidWheelParameters wheel;
  wheel.geometry.diameter = 2.0 * radius;
  wheel.geometry.width = width;
  wheel.geometry.segments = segments;
  wheel.geometry.element_size = 0.025;
  wheel.hub.inertia = {20.0, 0.6, 0.4};
  wheel.hub.centre = Vector3(0.0, 0.003, z);
  return wheel;
}

struct Load {
  double force_z = 0.0;     // [N]
  double resistance = 0.0;  // [N] against the travel
  double torque = 0.0;      // [N m] that drives the wheel
};

/// A wheel that rolls at constant height and slip; the ground is at z = 0.
struct Rolling {
  Rolling(const Soil& of, double cell, double slip, int segments = 360)
      : soil(of),
        wheel(wheel_at(radius - sinkage, segments)),
        field({1.2, 0.3, Vector2(0.3, 0.0), 0.0, cell}),
        contact(wheel, field, soil, {width, true}) {
    system.add(wheel, "wheel");
    system.add(contact, "contact");
    wheel.prescribe(Coordinate::x, speed);
    wheel.prescribe(Coordinate::spin, speed / (radius * (1.0 - slip)));
  }
  /// Rolls until the rut is steady, then over whole cells.
  Load mean() {
    constexpr double step = 2.5e-4;
    roll(static_cast<int>(0.2 / step), step);
    const int steps = static_cast<int>(0.08 / step);
    const Load sum = roll(steps, step);
    return {sum.force_z / steps, sum.resistance / steps, sum.torque / steps};
  }
  Load roll(int steps, double step) {
    Load sum;
    for (int n = 0; n < steps; ++n) {
      system.advance(step);
      sum.force_z -= wheel.constraint(Coordinate::z);
      sum.resistance += wheel.constraint(Coordinate::x);
      sum.torque += wheel.constraint(Coordinate::spin);
    }
    return sum;
  }

  Soil soil;
  RigidWheel wheel;
  HeightField field;
  ScmContact contact;
  CoupledSystem system;
};

/// Wong and Reece's integrals with the largest stress below the axle, by Simpson's rule.
Load wong_reece(const Soil& soil, double slip) {
  const double entry = std::acos(1.0 - sinkage / radius), k = soil.k_c / width + soil.k_phi;
  constexpr int intervals = 20000;
  Load load;
  for (int n = 0; n <= intervals; ++n) {
    const double weight = (n == 0 || n == intervals ? 1.0 : n % 2 ? 4.0 : 2.0) / 3.0;
    const double angle = entry * n / intervals;
    const double sigma =
        k * std::pow(std::max(0.0, radius * (std::cos(angle) - std::cos(entry))), soil.n);
    const double j = radius * (entry - angle - (1.0 - slip) * (std::sin(entry) - std::sin(angle)));
    const double tau = (soil.cohesion + sigma * std::tan(soil.friction_angle)) *
                       (1.0 - std::exp(-j / soil.shear_length));
    const double area = weight * entry / intervals * radius * width;
    load.force_z += area * (sigma * std::cos(angle) + tau * std::sin(angle));
    load.resistance += area * (sigma * std::sin(angle) - tau * std::cos(angle));
    load.torque += area * radius * tau;
  }
  return load;
}

/// Order p of an error C h^p, from values of cells h, h/2 and h/4.
double observed_order(const std::array<double, 3>& values) {
  return std::log2(std::abs((values[0] - values[1]) / (values[1] - values[2])));
}

/// Cells leave the wheel at the end of a step, so the contact is half a step too long.
constexpr double longer_contact = 0.002;  // of the forces

TEST(ScmWheel, TowedWheelConvergesToBekkersResistanceWithOrderTwo) {
  const Soil soil = without_shear();
  const double resistance =
      (soil.k_c + width * soil.k_phi) * std::pow(sinkage, soil.n + 1.0) / (soil.n + 1.0);
  const double load = wong_reece(soil, 0.0).force_z;
  std::array<double, 3> errors{}, loads{};
  for (std::size_t n = 0; n < 3; ++n) {
    const Load mean = Rolling(soil, 0.02 / std::pow(2.0, n), 0.0).mean();
    errors[n] = mean.resistance / resistance - 1.0;
    loads[n] = mean.force_z / load - 1.0;
    EXPECT_NEAR(mean.torque, 0.0, 1e-3 * radius * resistance);
  }
  EXPECT_NEAR(observed_order(errors), 2.0, 0.2);
  EXPECT_NEAR(observed_order(loads), 2.0, 0.2);
  EXPECT_NEAR(errors[2], 0.0, 5e-4);
  EXPECT_NEAR(loads[2], 0.0, longer_contact);
}

TEST(ScmWheel, DrivenWheelFollowsWongAndReece) {
  for (const double slip : {0.1, 0.4}) {
    const Load exact = wong_reece(sand(), slip), mean = Rolling(sand(), 0.005, slip).mean();
    EXPECT_NEAR(mean.force_z, exact.force_z, longer_contact * exact.force_z) << slip;
    EXPECT_NEAR(mean.torque, exact.torque, longer_contact * exact.torque) << slip;
    EXPECT_NEAR(mean.resistance, exact.resistance, longer_contact * exact.torque / radius) << slip;
  }
}

/// Work of axle and motor on the one side, of the soil on the other.
TEST(ScmWheel, WorkOfTheWheelIsDissipatedAndStored) {
  Soil soil = sand();
  soil.stiffness = 2e7;
  soil.flow = 0.5;
  double last_error = 0.0;
  for (const double step : {4e-4, 2e-4, 1e-4}) {
    Rolling rolling(soil, 0.01, 0.2, 180);
    rolling.roll(static_cast<int>(0.15 / step), step);
    const ScmContact::Losses before = rolling.contact.losses();
    const double stored = rolling.contact.step().stored,
                 work = rolling.wheel.energy_budget().contact_work;
    rolling.roll(static_cast<int>(0.2 / step), step);
    const ScmContact::Losses after = rolling.contact.losses();
    const double spent = after.compaction + after.shear + after.damping - before.compaction -
                         before.shear - before.damping + rolling.contact.step().stored - stored;
    const double given = work - rolling.wheel.energy_budget().contact_work;
    const double error = std::abs(given - spent) / given;
    EXPECT_LT(error, 30.0 * step) << step;
    EXPECT_GT(after.shear, before.shear);
    if (last_error > 0.0) {
      EXPECT_LT(error, 0.7 * last_error);
    }
    last_error = error;
  }
}

/// A wheel under a load sinks less in its rut than on undisturbed ground.
TEST(ScmWheel, SecondPassIsShallower) {
  Soil soil = sand();
  soil.stiffness = 2e7;
  RigidWheel wheel(wheel_at(radius, 180));
  HeightField field({1.4, 0.3, Vector2(0.3, 0.0), 0.0, 0.01});
  ScmContact contact(wheel, field, soil, {width, true});
  CoupledSystem system;
  system.add(wheel, "wheel");
  system.add(contact, "contact");
  wheel.release(Coordinate::z);
  wheel.release(Coordinate::spin);
  wheel.set_vertical_damping(2000.0);
  wheel.set_load(Vector3(0.0, 0.0, -400.0));
  std::array<double, 3> drop{};
  for (double& mean : drop) {
    wheel.place(Vector3(0.0, 0.003, mean == drop[0] ? radius : wheel.centre().z()), 0.0, 0.0);
    wheel.prescribe(Coordinate::x, 0.0);
    for (int n = 0; n < 500; ++n) system.advance(5e-4);
    wheel.prescribe(Coordinate::x, 0.5);
    for (int n = 0; n < 2000; ++n) {
      system.advance(5e-4);
      if (n >= 1600) mean += (radius - wheel.centre().z()) / 400.0;
    }
  }
  EXPECT_GT(drop[0], 0.02);
  EXPECT_LT(drop[1] - drop[0], 0.5 * drop[0]);
  EXPECT_GT(drop[1], drop[0]);
  EXPECT_LT(drop[2] - drop[1], drop[1] - drop[0]);
}

/// Upright sides have no pressure. With any camber the lower side does: its force is reported.
TEST(ScmWheel, SteepFacesGiveTheForceAlongTheAxle) {
  const auto after = [](double camber) {
    Rolling rolling(without_shear(), 0.01, 0.0, 180);
    rolling.wheel.place(rolling.wheel.centre(), 0.0, camber);
    rolling.roll(100, 2.5e-4);
    const Vector3 axle = rolling.wheel.axle();
    const ScmContact::Step& step = rolling.contact.step();
    return Vector3(step.of_steep_faces.dot(axle), step.force.dot(axle), step.force.z());
  };
  const Vector3 upright = after(0.0), cambered = after(1e-4);
  EXPECT_EQ(upright[0], 0.0);
  EXPECT_NEAR(upright[1], 0.0, 1e-12 * upright[2]);
  EXPECT_GT(std::abs(cambered[0]), 0.1 * cambered[2]);
  EXPECT_NEAR(cambered[0], cambered[1], 1e-3 * cambered[2]);
}

}  // namespace
}  // namespace furrow::scm_wheel_test
