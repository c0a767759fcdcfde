// SPDX-License-Identifier: GPL-2.0-or-later
#include "bodies/rigid_plate.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "tests/support/checkpoints.h"
#include "tests/support/error_of.h"

namespace furrow {
namespace {

using test::error_of;
using ::testing::HasSubstr;

PlateGeometry plate(PlateShape shape) { return {shape, 0.08, 0.005, 20}; }

class PlateMesh : public ::testing::TestWithParam<PlateShape> {};

// Closed form: volume and lower face of a prism.
TEST_P(PlateMesh, IsClosedWithTheExactAreaAndVolume) {
  const PlateGeometry geometry = plate(GetParam());
  const Surface surface = make_plate_mesh(geometry);
  EXPECT_TRUE(surface.is_closed());
  EXPECT_NEAR(surface.enclosed_volume(), geometry.area() * geometry.thickness,
              1e-12 * geometry.area());
  double lower = 0.0;
  for (std::size_t t = 0; t < surface.triangle_count(); ++t)
    if (surface.area_vector(t).z() < -1e-12) lower -= surface.area_vector(t).z();
  EXPECT_NEAR(lower, geometry.area(), 1e-12 * geometry.area());
  EXPECT_DOUBLE_EQ(surface.bounds().first.z(), 0.0);
  EXPECT_DOUBLE_EQ(surface.bounds().second.z(), geometry.thickness);
  EXPECT_GT(degrees(surface.minimum_angle()), 38.0);
}

INSTANTIATE_TEST_SUITE_P(Shapes, PlateMesh,
                         ::testing::Values(PlateShape::circle, PlateShape::square),
                         [](const auto& shape) {
                           return shape.param == PlateShape::circle ? "circle" : "square";
                         });

TEST(PlateMesh, RefusesShapesThatCannotBe) {
  PlateGeometry geometry = plate(PlateShape::circle);
  geometry.thickness = 1e-5;
  EXPECT_THAT(error_of([&] { make_plate_mesh(geometry, "fix plate/rigid"); }),
              HasSubstr("makes slivers at the edge"));
  geometry = plate(PlateShape::circle);
  geometry.elements = 7;
  EXPECT_THAT(error_of([&] { make_plate_mesh(geometry, "fix plate/rigid"); }),
              HasSubstr("an even number"));
  geometry.size = -1.0;
  EXPECT_THAT(error_of([&] { make_plate_mesh(geometry, "fix plate/rigid"); }),
              HasSubstr("keyword 'size' is -1; allowed: a number > 0 [m]"));
}

// A force of 3 N over 100 steps of 1 mm/s: work 3 N x 1e-4 m, given back by the drive.
TEST(RigidPlate, GoesDownAtItsSpeedAndAccountsForTheWork) {
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

TEST(RigidPlate, ContinuesFromItsStateAndRefusesAnother) {
  RigidPlate first(plate(PlateShape::circle), Vector3::Zero());
  first.prescribe(-0.01);
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
}  // namespace furrow
