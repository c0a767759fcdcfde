// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/geometry/thin_parts.h"

#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "furrow/geometry/meshes/wheel_mesh.h"
#include "tests/support/bar.h"

namespace furrow::thin_parts_geometry_test {
namespace {

TEST(ThinParts, BladeIsOnePart) {
  const Surface blade = test::bar({0.02, 0.5, 0.3});
  const std::vector<ThinPart> parts = find_thin_parts(blade, 0.05, 1.0, 3);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_NE(parts[0].region[0], parts[0].region[1]);
  const double side = parts[0].place(blade.x, {0.1, 0.0, 0.1}).height > 0.0 ? 1.0 : -1.0;
  const PlaceAtPart ahead = parts[0].place(blade.x, {side * 0.06, 0.1, 0.1}),
                    behind = parts[0].place(blade.x, {-side * 0.06, 0.1, 0.1});
  EXPECT_TRUE(ahead.beside);
  EXPECT_TRUE(behind.beside);
  EXPECT_NEAR(ahead.height, 0.06, 1e-15);
  EXPECT_NEAR(behind.height, -0.06, 1e-15);
}

/// Below the tip, past a side and above the upper end.
TEST(ThinParts, BladeEndsAtItsEdges) {
  const Surface blade = test::bar({0.02, 0.5, 0.3});
  const ThinPart part = find_thin_parts(blade, 0.05, 1.0, 3).at(0);
  for (const Vector3& beyond :
       {Vector3(0.05, 0, -0.01), Vector3(-0.05, 0.26, 0.1), Vector3(0.05, 0, 0.31)})
    EXPECT_FALSE(part.place(blade.x, beyond).beside);
  EXPECT_NEAR(std::abs(part.place(blade.x, {-0.05, 0, -0.1}).height), 0.05, 1e-15);
}

/// A floor of 1 m with a rib of 0.3 m.
TEST(ThinParts, WallThatCarriesARibDividesNoGround) {
  const double outline[8][2] = {{-0.5, 0.0},  {0.5, 0.0},    {0.5, 0.02},   {0.01, 0.02},
                                {0.01, 0.32}, {-0.01, 0.32}, {-0.01, 0.02}, {-0.5, 0.02}};
  Surface surface;
  surface.resize(16);
  for (int n = 0; n < 16; ++n)
    surface.x.col(n) = Vector3(outline[n % 8][0], n < 8 ? -0.25 : 0.25, outline[n % 8][1]);
  for (const auto& [a, b, c] : std::vector<std::array<int, 3>>{
           {0, 1, 3}, {1, 2, 3}, {0, 3, 6}, {0, 6, 7}, {3, 4, 5}, {3, 5, 6}}) {
    surface.triangles.push_back({a, b, c});
    surface.triangles.push_back({a + 8, c + 8, b + 8});
  }
  for (int n = 0; n < 8; ++n) {
    const int next = (n + 1) % 8;
    surface.triangles.push_back({n, n + 8, next + 8});
    surface.triangles.push_back({n, next + 8, next});
  }
  ASSERT_TRUE(surface.is_closed());
  ASSERT_GT(surface.enclosed_volume(), 0.0);
  const std::vector<ThinPart> parts = find_thin_parts(surface, 0.05, 1.0, 3);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_NEAR(std::abs(parts[0].place(surface.x, {0.1, 0.0, 0.2}).height), 0.1, 1e-12);
}

TEST(ThinParts, BlocksAndThickWallsHaveNoThinParts) {
  EXPECT_TRUE(find_thin_parts(test::bar({0.2, 0.2, 0.2}), 0.5, 1.0, 3).empty());
  EXPECT_TRUE(find_thin_parts(test::bar({0.06, 0.5, 0.3}), 0.05, 1.0, 3).empty());
}

/// The gap between two grousers is one region, also where their number is odd.
TEST(ThinParts, EveryGrouserDividesTwoGaps) {
  for (const int number : {14, 15}) {
    WheelGeometry wheel{0.4, 0.2, 0.0, 120, 0.02, {number, 0.03, 0.005, 0.0}};
    const Surface surface = make_wheel_mesh(wheel);
    const std::vector<ThinPart> parts = find_thin_parts(surface, 0.02, 0.2, 3);
    ASSERT_EQ(parts.size(), static_cast<std::size_t>(number));
    const auto region_at = [&](double angle) {  // of the nearest part
      const Vector3 x(0.21 * std::sin(angle), 0.0, 0.21 * std::cos(angle));
      double nearest = 1.0;
      int region = -1;
      for (const ThinPart& part : parts) {
        const PlaceAtPart place = part.place(surface.x, x);
        if (place.distance >= nearest) continue;
        nearest = place.distance;
        region = part.region[place.height >= 0.0 ? 0 : 1];
      }
      return region;
    };
    double first = 0.0;  // angle of a grouser
    for (const int n : parts[0].facets[0].nodes) {
      const Vector3 x = surface.x.col(n);
      first = std::atan2(x.x(), x.z());
    }
    const double pitch = 2.0 * pi / number;
    for (int gap = 0; gap < number; ++gap) {
      const double start = first + gap * pitch;
      EXPECT_EQ(region_at(start + 0.3 * pitch), region_at(start + 0.7 * pitch)) << gap;
      EXPECT_NE(region_at(start - 0.3 * pitch), region_at(start + 0.3 * pitch)) << gap;
    }
  }
}

/// A node inside of the tread beside the root is not beyond an end; one under the tip is.
TEST(ThinParts, GrouserExtendsIntoItsWheel) {
  const WheelGeometry wheel{0.4, 0.2, 0.0, 120, 0.02, {12, 0.03, 0.005, 0.0}};
  const Surface surface = make_wheel_mesh(wheel);
  int within = 0, under = 0;
  for (const ThinPart& part : find_thin_parts(surface, 0.02, 0.2, 3)) {
    Vector3 middle = Vector3::Zero();
    for (const ThinPart::Facet& facet : part.facets)
      for (const int n : facet.nodes) middle += surface.x.col(n);
    middle.y() = 0.0;
    middle.normalize();
    const Vector3 across = middle.cross(Vector3::UnitY());
    within += part.place(surface.x, 0.19 * middle + 0.01 * across).beside;
    under += part.place(surface.x, 0.24 * middle + 0.01 * across).beside;
  }
  EXPECT_EQ(within, 12);
  EXPECT_EQ(under, 0);
}

}  // namespace
}  // namespace furrow::thin_parts_geometry_test
