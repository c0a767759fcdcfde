// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/geometry/triangle_search.h"

#include <algorithm>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "furrow/geometry/closest_feature.h"
#include "furrow/bodies/rigid_plate.h"

namespace furrow::triangle_search_test {
namespace {

/// A disc of 0.3 m, 0.1 m thick, tilted: closed, with edges and corners of every kind.
Surface disc() {
  Surface surface = make_plate_mesh({PlateShape::circle, 0.3, 0.1, 6});
  const Eigen::AngleAxisd tilt(0.4, Vector3(1.0, 2.0, 0.5).normalized());
  surface.x = (tilt.toRotationMatrix() * surface.x).eval();
  return surface;
}

double distance_to(const Surface& surface, int t, const Vector3& point) {
  const Vector3i& n = surface.triangles[static_cast<std::size_t>(t)];
  return closest_point_on_triangle(point, surface.x.col(n[0]), surface.x.col(n[1]),
                                   surface.x.col(n[2]))
      .distance;
}

std::vector<Vector3> random_points(std::size_t count, double half) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-half, half);
  std::vector<Vector3> points;
  for (std::size_t n = 0; n < count; ++n)
    points.push_back(Vector3{place(random), place(random), place(random)});
  return points;
}

/// Against the visit of all triangles: no triangle within reach is ever missed.
TEST(TriangleSearch, FindsEveryTriangleWithinReach) {
  const Surface surface = disc();
  for (const double reach : {0.005, 0.03, 0.2}) {
    const TriangleSearch search(surface, reach, Vector3::Constant(-1.0), Vector3::Constant(1.0));
    std::size_t looked_at = 0, within = 0;
    for (const Vector3& point : random_points(2000, 0.3)) {
      const auto [first, last] = search.near(point);
      const std::set<int> found(first, last);
      EXPECT_EQ(found.size(), static_cast<std::size_t>(last - first));  // none twice
      looked_at += found.size();
      for (int t = 0; t < static_cast<int>(surface.triangle_count()); ++t)
        if (distance_to(surface, t, point) <= reach) {
          ++within;
          EXPECT_TRUE(found.count(t)) << "reach " << reach << ", triangle " << t;
        }
    }
    EXPECT_GT(within, 0u);
    EXPECT_LT(looked_at, 2000u * surface.triangle_count());  // it leaves most out
  }
}

TEST(TriangleSearch, SearchCoversTheGivenRegionAlone) {
  const Surface surface = disc();
  const TriangleSearch search(surface, 0.01, {-1, -1, -1}, {0.0, 1, 1});
  EXPECT_FALSE(search.covers({0.05, 0, 0}));
  EXPECT_EQ(search.near({0.05, 0, 0}).first, search.near({0.05, 0, 0}).second);
  EXPECT_TRUE(search.covers({-0.05, 0, 0}));
  const TriangleSearch nothing(surface, 0.01, {1, 1, 1}, {2, 2, 2});
  EXPECT_FALSE(nothing.covers({1.5, 1.5, 1.5}));
}

/// Ground that is one particle thick has no extent in one direction.
TEST(TriangleSearch, FlatRegionIsSearched) {
  const Surface surface = disc();
  const TriangleSearch search(surface, 0.05, {-1, 0.01, -1}, {1, 0.01, 1});
  const Vector3 point(0.0, 0.01, 0.06);
  ASSERT_TRUE(search.covers(point));
  const auto [first, last] = search.near(point);
  int within = 0;
  for (int t = 0; t < static_cast<int>(surface.triangle_count()); ++t)
    if (distance_to(surface, t, point) <= 0.05) {
      ++within;
      EXPECT_NE(std::find(first, last, t), last);
    }
  EXPECT_GT(within, 0);
}

/// The direction at the nearest feature tells inside from outside everywhere, as the crossings of a
/// ray do.
TEST(NodeTriangles, OutwardNormalAgreesWithTheEnclosedSide) {
  const Surface surface = disc();
  const NodeTriangles corners(surface);
  int inside = 0, features[4] = {};
  for (const Vector3& point : random_points(5000, 0.22)) {
    ClosestPoint closest{};
    closest.distance = 1e300;
    std::size_t triangle = 0;
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
      const Vector3i& n = surface.triangles[t];
      const ClosestPoint one = closest_point_on_triangle(point, surface.x.col(n[0]),
                                                         surface.x.col(n[1]), surface.x.col(n[2]));
      if (one.distance < closest.distance) {
        closest = one;
        triangle = t;
      }
    }
    const bool is_inside =
        closest.separation.dot(corners.outward(surface, triangle, closest.barycentric)) < 0.0;
    EXPECT_EQ(is_inside, encloses(surface, point)) << point.transpose();
    inside += is_inside ? 1 : 0;
    ++features[closest.feature_nodes()];
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(features[1], 10);  // corners, edges and faces were all met
  EXPECT_GT(features[2], 100);
  EXPECT_GT(features[3], 100);
}

}  // namespace
}  // namespace furrow::triangle_search_test
