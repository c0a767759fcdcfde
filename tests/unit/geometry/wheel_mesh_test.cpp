// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/geometry/meshes/wheel_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "tests/support/error_of.h"

namespace furrow::wheel_mesh_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;

/// The wheel of [Shoop2001] p. 27.
WheelGeometry tr_wheel() {
  WheelGeometry wheel;
  wheel.diameter = 0.74;
  wheel.width = 0.272;
  wheel.shoulder = 0.051;
  return wheel;
}

/// The wheel of the CMU sand tests, with grousers as high as theirs.
WheelGeometry grouser_wheel(double angle = 0.0) {
  WheelGeometry wheel;
  wheel.diameter = 0.116;
  wheel.width = 0.05;
  wheel.grousers = {24, 0.005, 0.002, angle};
  return wheel;
}

// Pappus' theorems for a cylinder with quarter-circle shoulders.
double true_volume(const WheelGeometry& w) {
  const double s = w.shoulder, inner = w.radius() - s;
  return pi * w.radius() * w.radius() * w.tread_width() +
         2.0 * pi * s * (inner * inner + 0.5 * pi * inner * s + 2.0 / 3.0 * s * s);
}
double true_area(const WheelGeometry& w) {
  const double s = w.shoulder, inner = w.radius() - s;
  return 2.0 * pi * w.radius() * w.tread_width() + 4.0 * pi * s * (0.5 * pi * inner + s) +
         2.0 * pi * inner * inner;
}

/// Integral of z^2 + x^2 over the enclosed volume: the moment of inertia about the axle at unit
/// density.
double axial_moment(const Surface& surface) {
  double moment = 0.0;
  for (const Vector3i& nodes : surface.triangles) {
    const Vector3 a = surface.x.col(nodes[0]), b = surface.x.col(nodes[1]),
                  c = surface.x.col(nodes[2]);
    const double volume = a.dot(b.cross(c)) / 6.0;  // of the tetrahedron with the origin
    for (const int axis : {0, 2}) {
      const double sum = a[axis] + b[axis] + c[axis];
      moment +=
          volume / 20.0 * (a[axis] * a[axis] + b[axis] * b[axis] + c[axis] * c[axis] + sum * sum);
    }
  }
  return moment;
}

int euler_characteristic(const Surface& surface) {
  std::set<std::pair<int, int>> edges;
  for (const Vector3i& nodes : surface.triangles)
    for (int k = 0; k < 3; ++k) edges.insert(std::minmax(nodes[k], nodes[(k + 1) % 3]));
  return static_cast<int>(surface.node_count()) - static_cast<int>(edges.size()) +
         static_cast<int>(surface.triangle_count());
}

void expect_sound(const Surface& surface) {
  EXPECT_TRUE(surface.is_closed());  // every edge by two triangles in opposite directions
  EXPECT_EQ(euler_characteristic(surface), 2);
  EXPECT_GE(surface.minimum_angle(), minimum_mesh_angle);
  EXPECT_GT(surface.enclosed_volume(), 0.0);  // outward
  Vector3 area = Vector3::Zero();
  for (std::size_t i = 0; i < surface.triangle_count(); ++i) area += surface.area_vector(i);
  EXPECT_NEAR(area.norm(), 0.0, 1e-13 * surface.total_area());
  std::set<std::array<int, 3>> seen;
  std::vector<bool> used(surface.node_count(), false);
  for (const Vector3i& nodes : surface.triangles) {
    std::array<int, 3> sorted{nodes[0], nodes[1], nodes[2]};
    std::sort(sorted.begin(), sorted.end());
    EXPECT_TRUE(seen.insert(sorted).second) << "duplicate triangle";
    for (const int node : sorted) used[static_cast<std::size_t>(node)] = true;
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0) << "unused nodes";
  for (Eigen::Index i = 0; i < surface.x.cols(); ++i)
    for (Eigen::Index j = 0; j < i; ++j)
      ASSERT_GT((surface.x.col(i) - surface.x.col(j)).norm(), 1e-9) << "two nodes at one place";
}

std::string refusal_of(const WheelGeometry& wheel) {
  return error_of<InputError>([&] { make_wheel_mesh(wheel, "fix wheel/rigid"); });
}

TEST(WheelMesh, DefaultWheelHasAbout1200WellShapedTriangles) {
  const Surface surface = make_wheel_mesh(tr_wheel());
  expect_sound(surface);
  EXPECT_GE(surface.triangle_count(), 1100u);
  EXPECT_LE(surface.triangle_count(), 1400u);
  EXPECT_GE(degrees(surface.minimum_angle()), 25.0);
}

TEST(WheelMesh, NormalsOfAPlainWheelPointAwayFromItsCentre) {
  const Surface surface = make_wheel_mesh(tr_wheel());  // convex
  for (std::size_t i = 0; i < surface.triangle_count(); ++i)
    EXPECT_GT(surface.area_vector(i).dot(surface.x.col(surface.triangles[i][0])), 0.0);
}

TEST(WheelMesh, FlatWheelHasTheVolumeOfTheCylinder) {
  WheelGeometry wheel = tr_wheel();
  wheel.shoulder = 0.0;
  for (const int segments : {12, 13, 64}) {
    wheel.segments = segments;
    const Surface surface = make_wheel_mesh(wheel);
    expect_sound(surface);
    EXPECT_NEAR(surface.enclosed_volume() / true_volume(wheel), 1.0, 1e-13);
  }
}

TEST(WheelMesh, VolumeAreaAndInertiaOfTheRoundedWheelConvergeWithSecondOrder) {
  std::array<double, 3> volume_error{}, area_error{}, inertia_error{};
  const double s = tr_wheel().shoulder, r = tr_wheel().radius();
  // pi/2 times the integral of radius^4 along the axle, shoulder by the binomials of (r - s) + s
  // cos
  const double c1 = pi / 4, c2 = 2.0 / 3.0, c3 = 3 * pi / 16, c4 = 8.0 / 15.0,
               d = r - s;  // integrals of cos^(k+1) over a quarter
  const double quarter =
      s * (std::pow(d, 4) + 4 * std::pow(d, 3) * s * c1 + 6 * d * d * s * s * c2 +
           4 * d * std::pow(s, 3) * c3 + std::pow(s, 4) * c4);
  const double inertia = 0.5 * pi * (std::pow(r, 4) * tr_wheel().tread_width() + 2.0 * quarter);
  for (std::size_t level = 0; level < 3; ++level) {
    WheelGeometry wheel = tr_wheel();
    wheel.segments = 48 << level;
    // 2, 4, 8 elements over a shoulder
    wheel.element_size = 0.5 * pi * wheel.shoulder / (2 << level);
    const Surface surface = make_wheel_mesh(wheel);
    volume_error[level] = std::abs(surface.enclosed_volume() / true_volume(wheel) - 1.0);
    area_error[level] = std::abs(surface.total_area() / true_area(wheel) - 1.0);
    inertia_error[level] = std::abs(axial_moment(surface) / inertia - 1.0);
  }
  for (const auto& error : {volume_error, area_error, inertia_error}) {
    EXPECT_LT(error[2], 1e-3);
    for (int level = 0; level < 2; ++level)
      EXPECT_NEAR(std::log2(error[level] / error[level + 1]), 2.0, 0.1);
  }
}

TEST(WheelMesh, TreadNodesLieOutsideTheCircleByTheEqualAreaFactor) {
  WheelGeometry wheel = tr_wheel();
  const Surface surface = make_wheel_mesh(wheel);
  const double step = 2.0 * pi / wheel.segments;
  const auto [low, high] = surface.bounds();
  EXPECT_NEAR(high.z() / wheel.radius(), std::sqrt(step / std::sin(step)), 1e-14);
  EXPECT_NEAR(high.z() / wheel.radius() - 1.0, step * step / 12.0, 2e-6);
  EXPECT_NEAR(high.y(), 0.5 * wheel.width, 1e-15);
  EXPECT_NEAR(low.y(), -0.5 * wheel.width, 1e-15);
}

TEST(WheelMesh, FullyRoundTreadAndRollerAreClosedSurfaces) {
  WheelGeometry wheel = tr_wheel();
  wheel.shoulder = 0.5 * wheel.width;
  expect_sound(make_wheel_mesh(wheel));
  wheel.width = 1.5;
  wheel.shoulder = 0.0;
  expect_sound(make_wheel_mesh(wheel));
}

TEST(WheelMesh, GrousersAddTheVolumeOfTheirPrisms) {
  const WheelGeometry wheel = grouser_wheel();
  const Surface surface = make_wheel_mesh(wheel);
  expect_sound(surface);
  const Grousers& bars = wheel.grousers;
  const double prisms = bars.number * bars.height * bars.thickness * wheel.width;
  EXPECT_NEAR((surface.enclosed_volume() - true_volume(wheel)) / prisms, 1.0, 1e-10);
}

TEST(WheelMesh, GrousersHaveTheirHeightAndThickness) {
  const WheelGeometry wheel = grouser_wheel();
  const Surface surface = make_wheel_mesh(wheel);
  double highest = 0.0, widest = 0.0;  // of the bar around the z axis
  for (Eigen::Index node = 0; node < surface.x.cols(); ++node) {
    const Vector3 x = surface.x.col(node);
    if (x.z() < wheel.radius() + 0.5 * wheel.grousers.height || std::abs(x.x()) > 0.004) continue;
    highest = std::max(highest, x.z());
    widest = std::max(widest, 2.0 * std::abs(x.x()));
  }
  // within the sag of the tread under the bar
  EXPECT_NEAR(highest - wheel.radius(), wheel.grousers.height, 1e-4);
  EXPECT_NEAR(widest, wheel.grousers.thickness, 1e-12);
}

// A skewed bar takes thickness/cos(angle) of the circumference; its edge gains x = y tan(angle)
// around the tread.
TEST(WheelMesh, SkewedGrousersFollowTheirLine) {
  for (const double angle : {radians(20.0), radians(-35.0)}) {
    const WheelGeometry wheel = grouser_wheel(angle);
    const Surface surface = make_wheel_mesh(wheel);
    expect_sound(surface);
    double near_end = 0.0, far_end = 0.0;
    int near_count = 0, far_count = 0;  // tops of the bar around the z axis at both ends
    for (Eigen::Index node = 0; node < surface.x.cols(); ++node) {
      const Vector3 x = surface.x.col(node);
      const double along = wheel.radius() * std::atan2(x.x(), x.z());
      if (std::hypot(x.x(), x.z()) < wheel.radius() + 0.9 * wheel.grousers.height) continue;
      const double line = x.y() * std::tan(angle);
      if (std::abs(along - line) > 0.004) continue;
      if (x.y() < -0.49 * wheel.width) near_end += along, ++near_count;
      if (x.y() > 0.49 * wheel.width) far_end += along, ++far_count;
    }
    ASSERT_GT(near_count, 0);
    ASSERT_EQ(near_count, far_count);
    EXPECT_NEAR(far_end / far_count - near_end / near_count, wheel.width * std::tan(angle), 1e-6);
  }
}

// The twisted facets between two rings of a skewed wheel bulge: an error of the order of facet
// length times ring spacing.
TEST(WheelMesh, VolumeOfSkewedGrousersConvergesWithSecondOrder) {
  const double angle = radians(30.0);
  WheelGeometry wheel = grouser_wheel(angle);
  const double prisms = wheel.grousers.number * wheel.grousers.height * wheel.grousers.thickness /
                        std::cos(angle) * wheel.width;
  std::array<double, 4> error{};
  for (std::size_t level = 0; level < 4; ++level) {
    wheel.segments = 60 << level;  // 2, 4, 8, 16 facets between two bars
    wheel.element_size = wheel.width / (10 << level);
    error[level] = (make_wheel_mesh(wheel).enclosed_volume() - true_volume(wheel)) / prisms - 1.0;
  }
  EXPECT_LT(std::abs(error[3]), 1e-3);
  EXPECT_NEAR(std::log2(error[2] / error[3]), 2.0, 0.1);
}

TEST(WheelMesh, GrousersOfManyShapesAreClosedSurfaces) {
  WheelGeometry wheel = tr_wheel();
  for (const Grousers& bars :
       {Grousers{18, 0.02, 0.005, radians(15)}, Grousers{18, 0.05, 0.05, radians(-15)},
        Grousers{1, 0.02, 0.05, 0.0}, Grousers{60, 0.01, 0.02, 0.0},
        Grousers{12, 0.03, 0.02, radians(45)}}) {
    wheel.grousers = bars;
    expect_sound(make_wheel_mesh(wheel));
  }
}

TEST(WheelMesh, DepthBelowTheCentreIsExact) {
  const WheelGeometry wheel = tr_wheel();
  EXPECT_DOUBLE_EQ(wheel.depth_below_centre(Vector3::UnitY()), 0.37);
  EXPECT_DOUBLE_EQ(wheel.depth_below_centre(Vector3::UnitZ()), 0.136);
  WheelGeometry fine = wheel;  // a cambered fine mesh reaches as deep
  fine.segments = 400;
  fine.element_size = 0.004;
  const Vector3 axle = Vector3(0.3, 0.9, 0.25).normalized();
  const Surface surface = make_wheel_mesh(fine);
  const Vector3 about = Vector3::UnitY().cross(axle);
  const Eigen::AngleAxisd turn(std::atan2(about.norm(), axle.y()), about.normalized());
  double lowest = 0.0;
  for (Eigen::Index node = 0; node < surface.x.cols(); ++node)
    lowest = std::min(lowest, (turn * Vector3(surface.x.col(node))).z());
  EXPECT_NEAR(-lowest, wheel.depth_below_centre(axle), 1e-4);
}

TEST(WheelMesh, RefusesImpossibleShapes) {
  WheelGeometry wheel = tr_wheel();
  wheel.diameter = -1;
  EXPECT_THAT(refusal_of(wheel),
              HasSubstr("fix wheel/rigid, diameter is -1; allowed: a number > 0 [m]"));
  wheel = tr_wheel();
  wheel.width = std::nan("");
  EXPECT_THAT(refusal_of(wheel), HasSubstr(", width is nan"));
  wheel = tr_wheel();
  wheel.shoulder = 0.14;
  EXPECT_THAT(refusal_of(wheel), HasSubstr("has shoulder 0.14 m; allowed: 0 to half the width, "
                                           "0.136 m, and below the radius, 0.37 m"));
  wheel.diameter = 0.25;
  wheel.shoulder = 0.13;
  EXPECT_THAT(refusal_of(wheel), HasSubstr("below the radius, 0.125 m"));
  wheel = tr_wheel();
  wheel.segments = 11;
  EXPECT_THAT(refusal_of(wheel), HasSubstr("has 11 segments; allowed: an integer >= 12"));
  wheel = tr_wheel();
  wheel.element_size = -0.1;
  EXPECT_THAT(refusal_of(wheel), HasSubstr("has element_size -0.1 m"));
  wheel.element_size = 1e-6;
  EXPECT_THAT(refusal_of(wheel),
              HasSubstr("triangles; allowed: at most 500000; give fewer segments"));
  wheel = tr_wheel();
  wheel.shoulder = 0.001;
  EXPECT_THAT(refusal_of(wheel), HasSubstr("would have sliver triangles"));
  wheel = tr_wheel();
  wheel.diameter = 740.0;
  EXPECT_THAT(refusal_of(wheel), HasSubstr("has a diameter of 740 m and a width of 0.272 m"));
}

TEST(WheelMesh, RefusesImpossibleGrousers) {
  WheelGeometry wheel = grouser_wheel();
  wheel.grousers.number = -1;
  EXPECT_THAT(refusal_of(wheel), HasSubstr("has -1 grousers"));
  wheel = grouser_wheel();
  wheel.grousers.height = 0.0;
  EXPECT_THAT(refusal_of(wheel), HasSubstr(", grouser_height is 0; allowed: a number > 0 [m]"));
  wheel = grouser_wheel();
  wheel.grousers.thickness = 0.0;
  EXPECT_THAT(refusal_of(wheel), HasSubstr(", grouser_thickness is 0"));
  wheel = grouser_wheel(radians(61.0));
  EXPECT_THAT(refusal_of(wheel),
              HasSubstr("has grouser_angle 61 degrees; allowed: -60 to 60 degrees"));
  wheel = grouser_wheel();
  wheel.grousers.thickness = 0.016;
  EXPECT_THAT(refusal_of(wheel), HasSubstr("has 24 grousers that overlap: each takes 0.016 m of "
                                           "the circumference, their pitch is 0.01518 m"));
  wheel.grousers.thickness = 0.010;
  wheel.grousers.angle = radians(50.0);  // 0.010 m fits, 0.010 m / cos(50 degrees) does not
  EXPECT_THAT(refusal_of(wheel), HasSubstr("overlap"));
  wheel = grouser_wheel();
  wheel.shoulder = 0.025;
  EXPECT_THAT(refusal_of(wheel), HasSubstr("no flat tread to carry them"));
}

}  // namespace
}  // namespace furrow::wheel_mesh_test
