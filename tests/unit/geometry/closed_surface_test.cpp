// SPDX-License-Identifier: GPL-2.0-or-later
// A surface that should be the skin of a solid: errors name the edge at fault.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "furrow/geometry/closed_surface.h"
#include "furrow/geometry/meshes/wheel_mesh.h"
#include "furrow/geometry/winding_number.h"
#include "furrow/core/error.h"

namespace furrow::closed_surface_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

Surface tetrahedron() {
  Surface surface;
  surface.resize(4);
  surface.x.col(1) = Vector3::UnitX();
  surface.x.col(2) = Vector3::UnitY();
  surface.x.col(3) = Vector3::UnitZ();
  surface.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return surface;
}

TEST(ClosedSurface, TetrahedronAndWheelAreClosed) {
  EXPECT_NO_THROW(check_closed(tetrahedron(), "tetrahedron"));
  WheelGeometry wheel;
  wheel.diameter = 0.6;
  wheel.width = 0.2;
  wheel.shoulder = 0.03;
  wheel.grousers = {12, 0.02, 0.01, 0.3};
  EXPECT_NO_THROW(check_closed(make_wheel_mesh(wheel), "wheel"));
}

TEST(WindingNumber, IsOneInsideAndZeroOutside) {
  EXPECT_NEAR(winding_number(tetrahedron(), Vector3(0.1, 0.2, 0.3)), 1.0, 1e-14);
  EXPECT_NEAR(winding_number(tetrahedron(), Vector3(0.5, 0.5, 0.5)), 0.0, 1e-14);
  WheelGeometry wheel;
  wheel.diameter = 0.6;
  wheel.width = 0.2;
  wheel.shoulder = 0.03;
  const Surface surface = make_wheel_mesh(wheel);
  for (const double radius : {0.0, 0.1, 0.29, 0.31, 0.4})
    EXPECT_NEAR(winding_number(surface, Vector3(0.0, 0.02, radius)), radius < 0.3 ? 1.0 : 0.0,
                1e-12)
        << radius;
}

/// From the right corner of the tetrahedron the opposite face fills an octant.
TEST(WindingNumber, OpenSurfaceGivesItsSolidAngle) {
  Surface surface = tetrahedron();
  surface.triangles = {{1, 2, 3}};
  EXPECT_NEAR(winding_number(surface, Vector3::Zero()), 1.0 / 8.0, 1e-14);
}

TEST(ClosedSurface, MissingTriangleIsAnOpenEdge) {
  Surface surface = tetrahedron();
  surface.triangles.pop_back();
  EXPECT_THAT([&] { check_closed(surface, "soil"); },
              ThrowsMessage<StateError>(
                  AllOf(HasSubstr("body 'soil': its surface is not closed"),
                        HasSubstr("the edge of nodes 1 and 2 belongs to one triangle"))));
}

TEST(ClosedSurface, TurnedTriangleIsNamed) {
  Surface surface = tetrahedron();
  std::swap(surface.triangles[3][0], surface.triangles[3][1]);
  EXPECT_THAT([&] { check_closed(surface, "soil"); },
              ThrowsMessage<StateError>(HasSubstr("turned inside out")));
}

TEST(ClosedSurface, FinOnASolidIsRefused) {
  Surface surface = tetrahedron();
  surface.triangles.push_back({0, 1, 2});
  EXPECT_THAT([&] { check_closed(surface, "soil"); },
              ThrowsMessage<StateError>(HasSubstr("belongs to more than two triangles")));
}

TEST(ClosedSurface, EmptySurfaceIsNotClosed) {
  EXPECT_THAT([] { check_closed(Surface(), "soil"); },
              ThrowsMessage<StateError>(HasSubstr("there are no triangles")));
}

}  // namespace
}  // namespace furrow::closed_surface_test
