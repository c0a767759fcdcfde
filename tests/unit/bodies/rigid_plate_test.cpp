// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/bodies/rigid_plate.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "furrow/core/error.h"
#include "tests/support/checkpoints.h"
#include "tests/support/error_of.h"

namespace furrow::rigid_plate_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;

PlateGeometry plate(PlateShape shape) { return {shape, 0.08, 0.005, 20}; }

/// [m2] what the surface covers seen from below
double lower_face(const Surface& surface) {
  double area = 0.0;
  for (std::size_t t = 0; t < surface.triangle_count(); ++t)
    if (surface.area_vector(t).z() < -1e-12) area -= surface.area_vector(t).z();
  return area;
}

class PlateMesh : public ::testing::TestWithParam<PlateShape> {};

// Closed form: volume and lower face of a prism.
TEST_P(PlateMesh, IsClosedWithTheExactAreaAndVolume) {
  const PlateGeometry geometry = plate(GetParam());
  const Surface surface = make_plate_mesh(geometry);
  EXPECT_TRUE(surface.is_closed());
  EXPECT_NEAR(surface.enclosed_volume(), geometry.area() * geometry.thickness,
              1e-12 * geometry.area());
  EXPECT_NEAR(lower_face(surface), geometry.area(), 1e-12 * geometry.area());
  EXPECT_DOUBLE_EQ(surface.bounds().first.z(), 0.0);
  EXPECT_DOUBLE_EQ(surface.bounds().second.z(), geometry.thickness);
  EXPECT_GT(degrees(surface.minimum_angle()), 38.0);
}

INSTANTIATE_TEST_SUITE_P(Shapes, PlateMesh,
                         ::testing::Values(PlateShape::circle, PlateShape::square),
                         [](const auto& shape) {
                           return shape.param == PlateShape::circle ? "circle" : "square";
                         });

// Closed forms: ring of a prism, lower face between both circles.
TEST(PlateMesh, AnnulusHasTheExactAreaAndVolume) {
  const PlateGeometry geometry{PlateShape::annulus, 0.2, 0.03, 16, 0.12};
  EXPECT_NEAR(geometry.area(), pi / 4.0 * (0.2 * 0.2 - 0.12 * 0.12), 1e-15);
  const Surface surface = make_plate_mesh(geometry);
  EXPECT_TRUE(surface.is_closed());
  EXPECT_NEAR(surface.enclosed_volume(), geometry.area() * 0.03, 1e-14);
  EXPECT_NEAR(lower_face(surface), geometry.area(), 1e-14);
}

// Closed form: a cone and its shaft, 0.783 of the base's diameter.
TEST(PlateMesh, ConeHasTheExactBaseAreaAndVolume) {
  for (const double angle : {30.0, 60.0}) {
    PlateGeometry geometry{PlateShape::cone, 0.02027, 0.1, 6};
    geometry.angle = angle;
    const Surface surface = make_plate_mesh(geometry);
    const double height = 0.5 * geometry.size / std::tan(radians(0.5 * angle));
    EXPECT_TRUE(surface.is_closed());
    EXPECT_NEAR(surface.enclosed_volume(),
                geometry.area() * (height / 3.0 + 0.783 * 0.783 * geometry.thickness), 1e-12);
    EXPECT_DOUBLE_EQ(surface.bounds().first.z(), 0.0);
    EXPECT_NEAR(surface.bounds().second.z(), height + geometry.thickness, 1e-15);
    EXPECT_NEAR(lower_face(surface), geometry.area(), 1e-14);
  }
}

TEST(PlateMesh, ImpossibleShapesAreRefused) {
  PlateGeometry geometry = plate(PlateShape::circle);
  geometry.thickness = 0.0;
  EXPECT_THAT(error_of([&] { make_plate_mesh(geometry, "fix plate/rigid"); }),
              HasSubstr("keyword 'thickness' is 0; allowed: a number > 0 [m]"));
  geometry.thickness = 1e-5;
  EXPECT_THAT(error_of([&] { make_plate_mesh(geometry, "fix plate/rigid"); }),
              HasSubstr("makes slivers at the edge"));
  geometry = plate(PlateShape::circle);
  geometry.elements = 7;
  EXPECT_THAT(error_of([&] { make_plate_mesh(geometry, "fix plate/rigid"); }),
              HasSubstr("an even number"));
  geometry = plate(PlateShape::annulus);
  EXPECT_THAT(error_of([&] { make_plate_mesh(geometry, "fix plate/rigid"); }),
              HasSubstr("keyword 'inner_size' is 0 m; allowed: a number in (0, 0.08) [m]"));
  geometry = plate(PlateShape::square);
  geometry.inner_size = 0.04;
  EXPECT_THAT(error_of([&] { make_plate_mesh(geometry, "fix plate/rigid"); }),
              HasSubstr("only for 'shape annulus'"));
  geometry = plate(PlateShape::circle);
  geometry.size = -1.0;
  EXPECT_THAT(error_of([&] { make_plate_mesh(geometry, "fix plate/rigid"); }),
              HasSubstr("keyword 'size' is -1; allowed: a number > 0 [m]"));
}

// A force of 3 N over 100 steps of 1 mm/s: work 3 N x 1e-4 m, given back by the drive.
TEST(RigidPlate, PlateMovesDownAtItsSpeedAndTheWorkBalances) {
  RigidPlate body(plate(PlateShape::square), {0.1, 0.2, 0.3});
  body.prescribe(-1e-3);
  for (int i = 0; i < 100; ++i) {
    body.surface().clear_forces();
    body.surface().f(2, 5) = 3.0;
    body.advance(1e-3);
  }
  EXPECT_NEAR(body.centre().z(), 0.3 - 1e-4, 1e-13);
  EXPECT_NEAR(body.surface().bounds().first.z(), 0.3 - 1e-4, 1e-13);
  EXPECT_DOUBLE_EQ(body.surface().v(2, 7), -1e-3);
  EXPECT_NEAR(body.energy_budget().contact_work, -3e-4, 1e-15);
  EXPECT_NEAR(body.energy_budget().residual(), 0.0, 1e-18);
  EXPECT_NEAR(body.mean_pressure(), 3.0 / (0.08 * 0.08), 1e-10);
}

// A tangential force of 2 N at the outer edge: work of the torque times the angle, and speed
// spin x radius.
TEST(RigidPlate, PlateTurnsAboutItsAxisAndTheWorkBalances) {
  RigidPlate body({PlateShape::annulus, 0.2, 0.03, 8, 0.12}, {0.1, 0.2, 0.3});
  body.prescribe(0.0, 0.5);
  const Vector3 start = body.surface().x.col(0);
  for (int i = 0; i < 1000; ++i) {
    body.surface().clear_forces();
    const Vector3 arm = body.surface().x.col(0) - body.centre();
    body.surface().f.col(0) = -2.0 * Vector3::UnitZ().cross(arm).normalized();
    EXPECT_NEAR(body.torque(), -2.0 * arm.head<2>().norm(), 1e-12);
    body.advance(1e-3);
  }
  const Vector3 arm = start - body.centre();
  const double radius = arm.head<2>().norm();
  EXPECT_NEAR(body.turned(), 0.5, 1e-12);
  EXPECT_NEAR((body.surface().x.col(0) - start).norm(), 2.0 * radius * std::sin(0.25), 1e-12);
  EXPECT_NEAR(body.surface().v.col(0).norm(), 0.5 * radius, 1e-12);
  EXPECT_NEAR(body.energy_budget().contact_work, -2.0 * radius * 0.5, 1e-12);
  EXPECT_NEAR(body.energy_budget().residual(), 0.0, 1e-15);
}

TEST(RigidPlate, RestartContinuesAndRefusesAnotherPlate) {
  RigidPlate first(plate(PlateShape::circle), Vector3::Zero());
  first.prescribe(-0.01, 0.3);
  first.surface().f(2, 0) = 1.0;
  first.advance(1e-3);
  RigidPlate second(plate(PlateShape::circle), Vector3::Zero());
  test::hand_over(first, second);
  first.advance(1e-3);
  second.advance(1e-3);
  EXPECT_EQ(first.surface().x, second.surface().x);
  EXPECT_EQ(test::state_of(first), test::state_of(second));

  RigidPlate other(plate(PlateShape::square), Vector3::Zero());
  EXPECT_THAT(error_of([&] { test::hand_over(first, other); }),
              HasSubstr("shape is 1, and was 0 when the checkpoint was written"));
}

TEST(RigidPlate, StopsOnNotANumber) {
  RigidPlate body(plate(PlateShape::circle), Vector3::Zero());
  EXPECT_THAT(error_of([&] { body.prescribe(std::nan("")); }),
              HasSubstr("prescribed velocity is nan"));
  body.surface().f(2, 0) = std::nan("");
  EXPECT_THAT(error_of([&] { body.advance(1e-3); }), HasSubstr("the force on it is nan"));
}

}  // namespace
}  // namespace furrow::rigid_plate_test
