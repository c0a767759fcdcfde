// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/discontinuities/slide_contact.h"

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "terrain_scene.h"
#include "tests/support/error_of.h"

namespace furrow::slide_contact_test {
namespace {

using namespace testing_terrain;

TEST(SlideSurface, SurfaceHasTwoSidesAndAnOutwardNormal) {
  const SlideSurface plane{SlidePlane{{1, 0, 0}, Vector3(0.6, 0, 0.8)}},
      cylinder{SlideCylinder{1, 2, 0.5}}, box{SlideBox{1, 2, 0.6, 0.4}};
  EXPECT_EQ(plane.side({0.9, 5, 0}), 0u);
  EXPECT_EQ(plane.side({0.9, 5, 0.1}), 1u);
  EXPECT_EQ(plane.normal({7, 7, 7}), Vector3(0.6, 0, 0.8));
  EXPECT_EQ(cylinder.side({1.3, 2.3, 9}), 0u);
  EXPECT_EQ(cylinder.side({1.4, 2.4, -9}), 1u);
  EXPECT_LT((cylinder.normal({1.3, 2.4, 1}) - Vector3(0.6, 0.8, 0)).norm(), 1e-15);
  EXPECT_EQ(cylinder.normal({1, 2, 1}).norm(), 1.0);
  EXPECT_EQ(box.side({1.29, 1.81, 0}), 0u);
  EXPECT_EQ(box.side({1.29, 1.79, 0}), 1u);
  EXPECT_EQ(box.normal({0.5, 2.1, 0}), -Vector3::UnitX());
  EXPECT_EQ(box.normal({1.1, 2.5, 0}), Vector3::UnitY());
}

/// All nodes have the two masses and velocities; one in the middle is looked at.
struct TwoFields {
  TwoFields(const Vector3& inner, const Vector3& outer, double friction, const Vector3& normal,
            BoundaryKind floor = BoundaryKind::free)
      : grid(Axis(even(0, 4, 1), "x"), Axis(even(0, 3, 1), "y"), Axis(even(0, 2, 1), "z"), 2) {
    grid.store(grid.all_nodes());
    for (int i = 0; i < grid.nodes(0); ++i)
      for (int j = 0; j < grid.nodes(1); ++j)
        for (int k = 0; k < grid.nodes(2); ++k)
          for (int field = 0; field < 2; ++field) {
            NodeMotion& node = grid.motion(i, j, k, field);
            Eigen::Map<Vector3>(node.velocity) = field == 0 ? inner : outer;
            node.mass = field == 0 ? inner_mass : outer_mass;
          }
    FaceArray<BoundaryKind> kinds;
    kinds.fill(BoundaryKind::free);
    kinds[Face::z_lower] = floor;
    const Boundary walls(grid, kinds, {2, 2, 2}, {});
    loss = SlideContact({SlidePlane{Vector3::Zero(), normal}, friction})
               .apply(grid, walls, grid.all_nodes(), {{2, 3}, {0, grid.nodes(1)}});
  }
  Vector3 velocity(int field, int level = 1) {
    return Eigen::Map<const Vector3>(grid.motion(2, 2, level, field).velocity);
  }
  static constexpr double inner_mass = 3.0, outer_mass = 1.0, reduced = 0.75;
  Grid grid;
  double loss;  // of a plane of 5 x 4 nodes [J]
};

TEST(SlideContact, SidesSeparateFreely) {
  TwoFields parting({-1, 2, 0}, {1, 0, 0}, 0.5, Vector3::UnitX());
  EXPECT_EQ(parting.velocity(0), Vector3(-1, 2, 0));
  EXPECT_EQ(parting.velocity(1), Vector3(1, 0, 0));
  EXPECT_EQ(parting.loss, 0.0);
}

/// w = (2, 3, 0): the approach 2 is stopped; of the sliding 3, mu 2 with mu = 0.5 takes 1.
TEST(SlideContact, StopsTheApproachAndSlowsTheSliding) {
  TwoFields sliding({1, 2, 0}, {-1, -1, 0}, 0.5, Vector3::UnitX());
  const Vector3 momentum = 3.0 * Vector3(1, 2, 0) + Vector3(-1, -1, 0),
                after = 3.0 * sliding.velocity(0) + sliding.velocity(1),
                w = sliding.velocity(0) - sliding.velocity(1);
  EXPECT_LT((after - momentum).norm(), 1e-14);
  EXPECT_LT((w - Vector3(0, 2, 0)).norm(), 1e-14);
  EXPECT_NEAR(sliding.loss, 20 * TwoFields::reduced * 1.0 * 2.0, 1e-12);
}

TEST(SlideContact, SidesStickBelowTheLimitOfFriction) {
  TwoFields sticking({1, 2, 0}, {-1, -1, 0}, 1.6, Vector3::UnitX());
  const Vector3 common(0.5, 1.25, 0);
  EXPECT_LT((sticking.velocity(0) - common).norm(), 1e-15);
  EXPECT_LT((sticking.velocity(1) - common).norm(), 1e-15);
  EXPECT_EQ(sticking.loss, 0.0);
}

/// At a smooth floor an inclined surface slides along the floor; a rough floor leaves nothing.
TEST(SlideContact, ContactDoesNothingAtNodesOfAWall) {
  const Vector3 inner(1, 0, 5), outer(-1, 0, -7), normal(0.6, 0, 0.8);
  TwoFields smooth(inner, outer, 0.0, normal, BoundaryKind::smooth);
  EXPECT_LT((smooth.velocity(0, 0) - Vector3(0.5, 0, 5)).norm(), 1e-15);
  EXPECT_LT((smooth.velocity(1, 0) - Vector3(0.5, 0, -7)).norm(), 1e-15);
  TwoFields rough(inner, outer, 0.0, normal, BoundaryKind::rough);
  EXPECT_EQ(rough.velocity(0, 0), inner);
  EXPECT_EQ(rough.velocity(1, 0), outer);
}

TEST(SlideContact, NeedsGroundOnBothSides) {
  TerrainParameters p = box(material_of(elastic(1e6, 0, 1000)), {0, 0, 0}, {1, 1, 1}, 0.25);
  p.slide = SlideSurface{SlideCylinder{3, 3, 1}, 0.0};
  EXPECT_THAT(test::error_of<InputError>([&] { ContinuumTerrain(p, Communicator()); }),
              ::testing::HasSubstr("leaves all of it on one side"));
}

}  // namespace
}  // namespace furrow::slide_contact_test
