// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies in sand by resistive force theory: plates, blades and spheres against closed forms, wheels
// as their faces become smaller, energy, restart.

#include "furrow/scm/rft_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "furrow/bodies/coupled_system.h"
#include "furrow/bodies/rigid_plate.h"
#include "furrow/bodies/rigid_wheel.h"
#include "furrow/core/error.h"
#include "furrow/scm/rft_law.h"
#include "tests/support/checkpoints.h"

namespace furrow::rft_contact_test {
namespace {

constexpr double strength = 1e6, slip_length = 1e-3, far = 1e3 * slip_length;
constexpr double plate_stress = 0.875;  // of the paper

/// A body that moves by prescribed distances through level sand at z = 0.
struct Pushing {
  Pushing(RigidPlate of, double friction)
      : plate(std::move(of)),
        field({4.0, 4.0, Vector2::Zero(), 0.0, 0.05}),
        contact(plate, field, {strength, friction, slip_length}) {}

  /// Moves it and returns the force of the sand at the new place [N].
  Vector3 move(const Vector3& by) {
    plate.surface().clear_forces();
    plate.prescribe(by);
    plate.advance(1.0);
    contact.apply(1.0);
    return plate.surface().total_force();
  }
  /// Force of the place where the body is, after a long way in this direction.
  Vector3 force_along(const Vector3& way) {
    move(-far * way);
    contact.apply(1.0);
    return move(far * way);
  }

  RigidPlate plate;
  HeightField field;
  RftContact contact;
};

RigidPlate square(double side, double z, double thickness = 0.02) {
  return {{PlateShape::square, side, thickness, 8}, Vector3(0.013, -0.007, z)};
}

/// A blade across x, a triangulated box whose corners are at these distances.
RigidPlate blade(const Vector3& size, double z) {
  Surface box;
  box.resize(8);
  for (int node = 0; node < 8; ++node)
    box.x.col(node) << (node & 1 ? 0.5 : -0.5) * size.x(), (node & 2 ? 0.5 : -0.5) * size.y(),
        (node & 4 ? 1.0 : 0.0) * size.z();
  for (const std::array<int, 4>& side :
       {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
        std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}}) {
    box.triangles.emplace_back(side[0], side[1], side[2]);
    box.triangles.emplace_back(side[0], side[2], side[3]);
  }
  return {{PlateShape::square, size.y(), size.z(), 2}, box, Vector3(0.0, 0.0, z)};
}

TEST(RftContact, ForceOfALevelPlateIsProportionalToDepth) {
  Pushing pushing(square(0.2, 0.0), 0.4);
  for (int step = 1; step <= 8; ++step) {
    const Vector3 force = pushing.move(Vector3(0.0, 0.0, -0.02));
    // its edges rub on the sand too
    EXPECT_NEAR(force.z(), plate_stress * strength * 0.02 * step * 0.04, 0.02 * force.z()) << step;
    EXPECT_NEAR(std::hypot(force.x(), force.y()), 0.0, 1e-9 * force.z());
  }
  Pushing smooth(square(0.2, 0.0), 0.0);
  const double once = smooth.move(Vector3(0.0, 0.0, -0.01)).z();
  EXPECT_NEAR(smooth.move(Vector3(0.0, 0.0, -0.01)).z(), 2.0 * once, 1e-3 * once);
  EXPECT_NEAR(once, plate_stress * strength * 0.01 * 0.04, 1e-3 * once);
}

/// The force 0.192 xi w h^2/2 acts at two thirds of the depth, for any triangles.
TEST(RftContact, UprightBladeHasTheForceAndTheMomentOfItsTriangleOfPressure) {
  const double width = 0.3, depth = 0.1;
  Pushing pushing(blade(Vector3(0.01, width, 0.25), -depth), 0.0);
  pushing.move(Vector3(0.0, 0.0, 0.0));
  const Vector3 force = pushing.force_along(Vector3::UnitX());
  const double upright = -rft_stress(Vector3::UnitX(), Vector3::UnitX(), 0.0).normal.x() * strength;
  EXPECT_NEAR(upright, 0.192 * strength, 1e-3 * upright);
  EXPECT_NEAR(force.x(), -0.5 * upright * width * depth * depth, 1e-9 * upright);
  const Surface& surface = pushing.plate.surface();
  const double moment = surface.total_moment(Vector3::Zero()).y(),
               of_lower_face = -force.z() * surface.x.row(0).mean();
  EXPECT_NEAR(moment - of_lower_face, -2.0 / 3.0 * depth * force.x(), 1e-6 * upright);
  EXPECT_NEAR(surface.total_moment(Vector3::Zero()).z(), 0.0, 1e-9 * upright);
}

TEST(RftContact, NodalForcesSumToTheContactForce) {
  Pushing pushing(blade(Vector3(0.05, 0.3, 0.2), -0.1), 0.5);
  pushing.plate.prescribe(Vector3(0.01, 0.02, -0.01), 0.3);
  pushing.plate.advance(0.1);
  pushing.contact.apply(0.1);
  const Vector3 force = pushing.contact.step().force;
  EXPECT_GT(force.norm(), 1.0);
  EXPECT_NEAR((pushing.plate.surface().total_force() - force).norm(), 0.0, 1e-12 * force.norm());
}

TEST(RftContact, ForceRotatesWithTheMotion) {
  Pushing along_x(blade(Vector3(0.1, 0.1, 0.2), -0.1), 0.3),
      along_y(blade(Vector3(0.1, 0.1, 0.2), -0.1), 0.3);
  along_x.move(Vector3::Zero());
  along_y.move(Vector3::Zero());
  const Vector3 x = along_x.force_along(Vector3::UnitX()),
                y = along_y.force_along(Vector3::UnitY());
  EXPECT_NEAR(x.x(), y.y(), 1e-10 * x.norm());
  EXPECT_NEAR(x.z(), y.z(), 1e-10 * x.norm());
  EXPECT_NEAR(x.y(), 0.0, 1e-10 * x.norm());
}

RigidPlate sphere(double radius, int rings, double z) {
  const int sectors = 2 * rings;
  Surface ball;
  ball.resize(static_cast<std::size_t>((rings - 1) * sectors + 2));
  const auto node = [&](int ring, int sector) {
    if (ring == 0) return 0;
    if (ring == rings) return (rings - 1) * sectors + 1;
    return 1 + (ring - 1) * sectors + sector % sectors;
  };
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const double polar = pi * i / rings, around = 2.0 * pi * j / sectors;
      ball.x.col(node(i, j)) << radius * std::sin(polar) * std::cos(around),
          radius * std::sin(polar) * std::sin(around), -radius * std::cos(polar);
    }
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const int a = node(i, j), b = node(i, j + 1), c = node(i + 1, j + 1), d = node(i + 1, j);
      if (i > 0) ball.triangles.emplace_back(a, b, c);
      if (i + 1 < rings) ball.triangles.emplace_back(a, c, d);
    }
  return {{PlateShape::circle, 2.0 * radius, radius, 8}, ball, Vector3(0.0, 0.0, z)};
}

/// Integral over the lower half of a sphere, whose stress depends on the polar angle alone.
double force_on_sphere(double radius, double depth, double friction) {
  constexpr int intervals = 2000;
  double force = 0.0;
  for (int k = 0; k <= intervals; ++k) {
    const double weight = (k == 0 || k == intervals ? 1.0 : k % 2 ? 4.0 : 2.0) / 3.0;
    const double angle = 0.5 * pi * k / intervals;
    const RftStress stress =
        rft_stress(Vector3(std::sin(angle), 0.0, -std::cos(angle)), -Vector3::UnitZ(), friction);
    force += weight * 0.5 * pi / intervals * 2.0 * pi * radius * radius * std::sin(angle) *
             (stress.normal + stress.tangent).z() * strength * (depth + radius * std::cos(angle));
  }
  return force;
}

TEST(RftContact, SphereConvergesToItsIntegralWithOrderTwo) {
  const double radius = 0.1, depth = 0.3;
  std::array<double, 3> errors{};
  for (std::size_t k = 0; k < errors.size(); ++k) {
    Pushing pushing(sphere(radius, 16 << k, far - depth), 0.3);
    const Vector3 force = pushing.move(Vector3(0.0, 0.0, -far));
    errors[k] = force.z() / force_on_sphere(radius, depth, 0.3) - 1.0;
    EXPECT_NEAR(std::hypot(force.x(), force.y()), 0.0, 1e-9 * force.z());
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2.0, 0.2);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2.0, 0.2);
  EXPECT_NEAR(errors[2], 0.0, 2e-3);
}

/// After a reversal the resistance falls by 1 - 2 exp(-s/K) over the way s, and vanishes.
TEST(RftContact, ReversalReleasesOverTheSlipLengthAndDissipates) {
  Pushing pushing(square(0.2, 0.0), 0.0);
  const double loaded = pushing.move(Vector3(0.0, 0.0, -0.02)).z(), up = 0.4 * slip_length;
  const double released = pushing.move(Vector3(0.0, 0.0, up)).z();
  EXPECT_NEAR(released / loaded, (2.0 * std::exp(-0.4) - 1.0) * (1.0 - up / 0.02), 1e-6);
  EXPECT_EQ(pushing.move(Vector3(0.0, 0.0, slip_length)).z(), 0.0);
}

/// Sand gives back F K (1 - ln 2) at most (theory: rft, eq. 4), and cycles take work.
TEST(RftContact, ReversedSandReturnsLimitedWorkAndCyclesDissipate) {
  Pushing pushing(square(0.2, 0.0), 0.0);
  Vector3 force = Vector3::Zero();
  for (int step = 0; step < 50; ++step) force = pushing.move(Vector3(0.0, 0.0, -4e-4));
  const double pushed = pushing.contact.losses().pressure;
  std::array<double, 41> loss{};
  for (double& after : loss) {
    for (const double sign : {1.0, -1.0})
      for (int step = 0; step < 100; ++step) pushing.move(Vector3(0.0, 0.0, sign * 5e-6));
    after = pushing.contact.losses().pressure;
  }
  const double limit = force.z() * slip_length * (1.0 - std::log(2.0));
  const double least = *std::min_element(loss.begin(), loss.end());
  EXPECT_LT(least, pushed - 0.1 * limit);
  EXPECT_GT(least, pushed - limit);
  EXPECT_GT(loss[40], loss[20] + 0.1 * limit);
}

TEST(RftContact, WorkOfTheBodyIsThatOfPressureAndShear) {
  Pushing pushing(blade(Vector3(0.05, 0.2, 0.3), -0.05), 0.4);
  const Vector3 way(1e-3, 5e-4, -2e-3);
  double work = 0.0;
  for (int step = 0; step < 40; ++step) work -= pushing.move(way).dot(way);
  const RftContact::Losses& losses = pushing.contact.losses();
  EXPECT_GT(losses.shear, 0.0);
  EXPECT_NEAR(losses.pressure + losses.shear, work, 1e-12 * work);
}

RigidWheelParameters wheel_of(int segments, double sinkage) {
  RigidWheelParameters wheel;
  wheel.geometry.diameter = 0.5;
  wheel.geometry.width = 0.1;
  wheel.geometry.segments = segments;
  wheel.geometry.grousers.number = 12;
  wheel.geometry.grousers.height = 0.02;
  wheel.geometry.grousers.thickness = 0.01;
  wheel.hub.inertia = {20.0, 0.6, 0.4};
  wheel.hub.centre = Vector3(0.0, 0.0, 0.25 - sinkage);
  return wheel;
}

struct Load {
  Vector3 force = Vector3::Zero();  // of the sand [N]
  double torque = 0.0;              // of the sand about the axle [N m]
};

/// Mean over a pitch of the grousers at constant height.
Load rolling(int segments, double slip, double friction) {
  RigidWheel wheel(wheel_of(segments, 0.03));
  HeightField field({3.0, 0.6, Vector2(0.5, 0.0), 0.0, 0.05});
  RftContact contact(wheel, field, {strength, friction, slip_length});
  CoupledSystem system;
  system.add(wheel, "wheel");
  system.add(contact, "sand");
  const double spin = 1.0;
  wheel.prescribe(Coordinate::x, spin * 0.25 * (1.0 - slip));
  wheel.prescribe(Coordinate::spin, spin);
  constexpr int steps = 400;
  const double pitch = 2.0 * pi / 12.0 / spin;
  for (int step = 0; step < steps / 2; ++step) system.advance(pitch / steps);
  Load mean;
  for (int step = 0; step < steps; ++step) {
    system.advance(pitch / steps);
    mean.force.x() -= wheel.constraint(Coordinate::x) / steps;
    mean.force.z() -= wheel.constraint(Coordinate::z) / steps;
    mean.torque -= wheel.constraint(Coordinate::spin) / steps;
  }
  return mean;
}

TEST(RftContact, WheelWithGrousersConvergesAsItsFacesBecomeSmaller) {
  std::array<Load, 3> loads;
  for (std::size_t k = 0; k < loads.size(); ++k) loads[k] = rolling(48 << k, 0.2, 0.4);
  const auto change = [&](std::size_t k) {
    return Vector3((loads[k].force - loads[2].force) / loads[2].force.z()).norm();
  };
  EXPECT_LT(change(1), 0.5 * change(0));
  EXPECT_LT(change(1), 0.01);
  EXPECT_NEAR(loads[1].torque, loads[2].torque, 0.01 * std::abs(loads[2].torque));
}

TEST(RftContact, PullGrowsWithSlip) {
  const double braked = rolling(60, -0.5, 0.4).force.x(), towed = rolling(60, 0.0, 0.4).force.x(),
               driven = rolling(60, 0.3, 0.4).force.x();
  EXPECT_LT(braked, towed);
  EXPECT_LT(towed, driven);
}

TEST(RftContact, DepthIsMeasuredFromTheUnevenField) {
  HeightField field({1.0, 0.6, Vector2(0.1, 0.0), 0.0, 0.05});
  const auto plane = [](const Vector2& place) { return 0.1 * place.x() - 0.2 * place.y() - 0.3; };
  for (std::size_t cell = 0; cell < field.cells(); ++cell)
    field.press(cell, plane(field.centre(cell)));
  for (const Vector2& place : {Vector2(0.013, 0.021), Vector2(-0.3, -0.17), Vector2(0.5, 0.2)})
    EXPECT_NEAR(field.height(place), plane(place), 1e-14);
  const HeightField one({0.1, 0.1, Vector2::Zero(), 0.2, 0.1});
  EXPECT_EQ(one.height(Vector2(0.03, -0.02)), 0.2);
}

TEST(RftContact, BodyBeyondTheFieldIsRefused) {
  RigidPlate plate = square(0.2, -0.01);
  HeightField field({0.15, 0.6, Vector2::Zero(), 0.0, 0.05});
  RftContact contact(plate, field, {strength, 0.4, slip_length});
  EXPECT_THROW(contact.apply(1.0), StateError);
}

TEST(RftContact, ContinuesFromItsCheckpoint) {
  Pushing whole(square(0.2, 0.0), 0.4), continued(square(0.2, 0.0), 0.4);
  for (int step = 0; step < 5; ++step) whole.move(Vector3(1e-4, 0.0, -3e-4));
  test::hand_over(whole.plate, continued.plate);
  test::hand_over(whole.contact, continued.contact);
  for (const double z : {-3e-4, 2e-4, -1e-4})
    EXPECT_EQ(whole.move(Vector3(0.0, 1e-4, z)), continued.move(Vector3(0.0, 1e-4, z)));
  EXPECT_EQ(whole.contact.losses().shear, continued.contact.losses().shear);
  Pushing other(square(0.2, 0.0), 0.5);
  EXPECT_THROW(test::hand_over(whole.contact, other.contact), Error);
}

}  // namespace
}  // namespace furrow::rft_contact_test
