// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/geometry/surface.h"

#include <limits>
#include <random>

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "tests/support/error_of.h"

namespace furrow::surface_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;

/// A tetrahedron with three unit edges from its corner: volume 1/6, closed, outward.
Surface tetrahedron(const Vector3& corner = Vector3::Zero()) {
  Surface surface;
  surface.resize(4);
  surface.x << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  surface.x.colwise() += corner;
  surface.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return surface;
}

TEST(Surface, ResizeZeroesAllArrays) {
  Surface surface;
  surface.resize(5);
  EXPECT_EQ(surface.node_count(), 5u);
  EXPECT_EQ(surface.triangle_count(), 0u);
  EXPECT_EQ(surface.x, Matrix3X::Zero(3, 5));
  EXPECT_EQ(surface.v, Matrix3X::Zero(3, 5));
  EXPECT_EQ(surface.f, Matrix3X::Zero(3, 5));
}

TEST(Surface, ForcesByBarycentricWeightsKeepForceAndMomentToRoundOff) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Surface surface = tetrahedron({3.0, -2.0, 1.0});
  const Vector3 about(0.1, 0.2, 0.3);
  Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
  for (int i = 0; i < 1000; ++i) {
    const Vector3i nodes = surface.triangles[static_cast<std::size_t>(i % 4)];
    // also outside of the triangle, on its plane
    const double beta = unit(random), gamma = unit(random);
    const Vector3 weights(1.0 - beta - gamma, beta, gamma);
    const Vector3 applied{unit(random), unit(random), unit(random)};
    Vector3 point = Vector3::Zero();
    for (int corner = 0; corner < 3; ++corner) {
      point += weights[corner] * surface.x.col(nodes[corner]);
      surface.f.col(nodes[corner]) += weights[corner] * applied;
    }
    force += applied;
    moment += (point - about).cross(applied);
  }
  EXPECT_NEAR((surface.total_force() - force).norm(), 0.0, 1e-12);
  EXPECT_NEAR((surface.total_moment(about) - moment).norm(), 0.0, 5e-12);
  surface.clear_forces();
  EXPECT_EQ(surface.total_force(), Vector3(Vector3::Zero()));
}

TEST(Surface, VolumeAndAreaVectorsOfATetrahedronFarFromTheOrigin) {
  const Surface surface = tetrahedron({1e6, -1e6, 1e6});
  EXPECT_NEAR(surface.enclosed_volume(), 1.0 / 6.0, 1e-14);
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 0; i < surface.triangle_count(); ++i) sum += surface.area_vector(i);
  EXPECT_NEAR(sum.norm(), 0.0, 1e-14);
  EXPECT_NEAR(surface.area_vector(3).norm(), std::sqrt(3.0) / 2.0, 1e-14);
  EXPECT_NEAR(surface.total_area(), 1.5 + std::sqrt(3.0) / 2.0, 1e-14);
  EXPECT_NEAR(surface.minimum_angle(), pi / 4.0, 1e-14);
}

TEST(Surface, BoundsAreTheExtremeCorners) {
  const auto [low, high] = tetrahedron({1, 2, 3}).bounds();
  EXPECT_EQ(low, Vector3(1, 2, 3));
  EXPECT_EQ(high, Vector3(2, 3, 4));
  EXPECT_THAT(error_of<StateError>([] { Surface().bounds(); }), HasSubstr("without nodes"));
}

TEST(Surface, ClosedSurfaceHasEveryEdgeTwiceInOppositeDirections) {
  EXPECT_TRUE(tetrahedron().is_closed());
  EXPECT_FALSE(Surface().is_closed());

  Surface open = tetrahedron();
  open.triangles.pop_back();
  EXPECT_FALSE(open.is_closed());

  Surface flipped = tetrahedron();
  std::swap(flipped.triangles[2][0], flipped.triangles[2][1]);
  EXPECT_FALSE(flipped.is_closed());

  Surface doubled = tetrahedron();
  doubled.triangles.insert(doubled.triangles.end(), doubled.triangles.begin(),
                           doubled.triangles.begin() + 4);
  EXPECT_FALSE(doubled.is_closed());

  Surface degenerate = tetrahedron();
  degenerate.triangles.push_back({0, 0, 1});
  degenerate.triangles.push_back({1, 0, 0});
  EXPECT_FALSE(degenerate.is_closed());
}

TEST(Surface, NotANumberIsReportedWithBodyAndNode) {
  Surface surface = tetrahedron();
  EXPECT_NO_THROW(surface.check_finite("wheel"));
  surface.v(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(error_of<StateError>([&] { surface.check_finite("wheel"); }),
              HasSubstr("body 'wheel': the velocity of node 2 is not finite (0 nan 0)"));
  surface.x(0, 1) = std::numeric_limits<double>::infinity();
  EXPECT_THAT(error_of<StateError>([&] { surface.check_finite("wheel"); }),
              HasSubstr("the position of node 1 is not finite"));
}

}  // namespace
}  // namespace furrow::surface_test
