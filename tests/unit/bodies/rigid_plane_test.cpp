// SPDX-License-Identifier: GPL-2.0-or-later
// The rigid floor: pressure by penetration, sticking and sliding by Coulomb's law, continuation.

#include "furrow/bodies/rigid_plane.h"

#include <gmock/gmock.h>

#include "furrow/bodies/rigid_plate.h"
#include "furrow/core/error.h"
#include "tests/support/checkpoints.h"
#include "tests/support/error_of.h"

namespace furrow::rigid_plane_test {
namespace {

constexpr double side = 0.2;

Surface plate_at(double height) {
  Surface surface = make_plate_mesh({PlateShape::square, side, 0.02, 8}, "plate");
  surface.x.row(2).array() += height;
  return surface;
}

TEST(RigidPlane, NodalForceIsPressureTimesNodalArea) {
  Surface surface = plate_at(-1e-4);
  RigidPlane plane({0.0, 1e8, 0.0, 0.0, 1e8}, surface);
  plane.press_on(surface);
  // Lower face of side^2 and, at its edge, half of the sides 0.02 m high (their own triangles'
  // shares)
  const double lower = side * side, sides = 0.5 * 4.0 * side * 0.02;
  EXPECT_NEAR(plane.total_force().z(), 1e8 * 1e-4 * (lower + sides), 0.1 * 1e8 * 1e-4 * sides);
  EXPECT_NEAR(surface.total_force().z(), plane.total_force().z(), 1e-9);
  EXPECT_NEAR(plane.pressure().maxCoeff(), 1e4, 1e-6);
  surface.clear_forces();
  surface.x.row(2).array() += 2e-4;
  plane.press_on(surface);
  EXPECT_EQ(surface.f.cwiseAbs().maxCoeff(), 0.0);
}

TEST(RigidPlane, FrictionSticksAndSlides) {
  Surface surface = plate_at(-1e-4);
  RigidPlane plane({0.0, 1e8, 0.0, 0.5, 1e8}, surface);
  plane.press_on(surface);
  EXPECT_EQ(plane.total_force().x(), 0.0);
  const double weight = plane.total_force().z();
  surface.x.row(0).array() += 2e-5;  // shear stress 2e3 of at most 5e3 Pa: sticks
  surface.clear_forces();
  plane.press_on(surface);
  EXPECT_NEAR(plane.total_force().x(), -0.2 * weight, 1e-9 * weight);
  surface.x.row(0).array() += 1e-3;  // slides
  surface.clear_forces();
  plane.press_on(surface);
  EXPECT_NEAR(plane.total_force().x(), -0.5 * weight, 1e-9 * weight);
  // back by the spring's stretch: free of force, at the new place
  surface.x.row(0).array() -= 5e-5;
  surface.clear_forces();
  plane.press_on(surface);
  EXPECT_NEAR(plane.total_force().x(), 0.0, 1e-9 * weight);
}

TEST(RigidPlane, DampingPushesButNeverPulls) {
  Surface surface = plate_at(-1e-4);
  RigidPlane plane({0.0, 1e8, 1e5, 0.0, 1e8}, surface);
  surface.v.row(2).setConstant(-0.05);
  plane.press_on(surface);
  EXPECT_NEAR(plane.pressure().maxCoeff(), 1e4 + 5e3, 1e-6);
  surface.v.row(2).setConstant(1.0);
  plane.press_on(surface);
  EXPECT_EQ(plane.pressure().maxCoeff(), 0.0);
}

// Dragged along, a plate loses mu N for each metre that it slides; what the springs give way is
// kept.
TEST(RigidPlane, SlidingDissipatesFrictionForceTimesDistance) {
  Surface surface = plate_at(-1e-4);
  RigidPlane plane({0.0, 1e8, 0.0, 0.5, 1e8}, surface);
  plane.press_on(surface);
  const double give = 0.5 * 1e-4;  // mu p/k
  EXPECT_EQ(plane.friction_loss(), 0.0);
  for (int i = 0; i < 100; ++i) {
    surface.clear_forces();
    surface.x.row(0).array() += 1e-5;
    plane.press_on(surface);
  }
  const double limit = std::abs(plane.total_force().x());
  EXPECT_NEAR(limit, 0.5 * plane.total_force().z(), 1e-9 * limit);
  EXPECT_NEAR(plane.friction_loss(), limit * (1e-3 - give), 1e-9 * limit * 1e-3);
}

TEST(RigidPlane, RestartContinuesBitwise) {
  Surface surface = plate_at(-1e-4);
  const RigidPlaneParameters parameters{0.0, 1e8, 0.0, 0.5, 1e8};
  RigidPlane plane(parameters, surface);
  plane.press_on(surface);
  surface.x.row(1).array() += 3e-5;
  Surface moved = surface;
  moved.x *= 1.1;  // another shape, whose areas must not count
  moved.x.row(2) = surface.x.row(2);
  RigidPlane other(parameters, moved);
  test::hand_over(plane, other);
  EXPECT_GT(plane.total_force().z(), 0.0);
  EXPECT_EQ(plane.total_force(), other.total_force());  // the first output of the continued run
  EXPECT_EQ(plane.pressure(), other.pressure());
  plane.press_on(surface);
  other.press_on(surface);
  EXPECT_EQ(plane.total_force(), other.total_force());
  EXPECT_LT(plane.total_force().y(), 0.0);
}

TEST(RigidPlane, RefusesValuesOutOfRange) {
  const Surface surface = plate_at(0.0);
  EXPECT_EQ(test::error_of<InputError>([&] {
              RigidPlane({0.0, -1.0, 0.0, 0.5, 1e8}, surface);
            }),
            "rigid plane, stiffness is -1; allowed: a number > 0 [Pa/m]");
  EXPECT_THROW(RigidPlane({0.0, 1e8, 0.0, -0.5, 1e8}, surface), InputError);
}

}  // namespace
}  // namespace furrow::rigid_plane_test
