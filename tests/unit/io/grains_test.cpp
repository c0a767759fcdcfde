// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/formats/grains.h"

#include <gmock/gmock.h>

#include "scratch.h"
#include "tests/support/error_of.h"

namespace furrow::grains_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;

Grains three_grains() {
  Grains grains;
  grains.resize(3);
  grains.id = {7, 3, 5};
  grains.radius.setConstant(0.01);
  grains.x << 0.1, 0.2, 0.3, 0.0, 0.0, 0.0, 0.5, 0.5, 0.5;
  return grains;
}

TEST(Grains, DisplacementMatchesIdsInAnyOrder) {
  const Grains reference = three_grains();
  Grains moved = reference;
  moved.id = {3, 5, 7};
  moved.x.col(0) = reference.x.col(1) + Vector3(1, 2, 3);
  moved.x.col(1) = reference.x.col(2);
  moved.x.col(2) = reference.x.col(0) + Vector3(-1, 0, 0);
  Matrix3X expected(3, 3);
  expected << 1, 0, -1, 2, 0, 0, 3, 0, 0;
  EXPECT_LT((moved.displacement_from(reference) - expected).norm(), 1e-15);
}

TEST(Grains, DisplacementUsesTheNearestPeriodicImage) {
  Grains reference = three_grains();
  reference.period = Vector3(0, 0.4, 0);
  reference.x(1, 0) = 0.19;
  Grains moved = reference;
  moved.x(1, 0) = -0.18;  // left at +0.2, came back at -0.2
  EXPECT_NEAR(moved.displacement_from(reference)(1, 0), 0.03, 1e-15);
}

TEST(Grains, BodyIsShiftedToThePeriodicImageOfTheGrains) {
  Grains grains = three_grains();
  const Vector3 middle = 0.5 * (grains.x.rowwise().minCoeff() + grains.x.rowwise().maxCoeff()),
                place = middle + Vector3(0.1, 0.7, 5.0);
  EXPECT_EQ(grains.shift_to_image(place), Vector3::Zero());
  grains.period = Vector3(1.0, 0.4, 0.0);
  EXPECT_LT((grains.shift_to_image(place + Vector3(3, 0, 0)) - Vector3(-3, -0.8, 0)).norm(), 1e-14);
  EXPECT_EQ(Grains().shift_to_image(place), Vector3::Zero());
}

TEST(Grains, GrainWithoutReferenceHasNoDisplacement) {
  const Grains reference = three_grains();
  Grains moved = reference;
  moved.id[1] = 99;
  const Matrix3X displacement = moved.displacement_from(reference);
  EXPECT_TRUE(displacement.col(1).array().isNaN().all());
  EXPECT_TRUE(displacement.col(0).isZero());
}

TEST(Grains, FaultyGrainsAreRefusedWithTheFault) {
  Grains twice = three_grains();
  twice.id[2] = 7;
  EXPECT_THAT(error_of([&] { twice.check(); }), HasSubstr("id 7 is there twice"));
  Grains lost = three_grains();
  lost.x(2, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(error_of([&] { lost.check(); }), HasSubstr("of grain 3 is not finite"));
  Grains uneven = three_grains();
  uneven.radius.resize(2);
  EXPECT_THAT(error_of([&] { uneven.check(); }),
              HasSubstr("3 ids, 3 positions, 3 velocities, 2 radii"));
  Grains pressed = three_grains();
  pressed.virial = Matrix3X::Zero(3, 2);
  EXPECT_THAT(error_of([&] { pressed.check(); }), HasSubstr("2 virials for 3 ids"));
  EXPECT_EQ(error_of([&] { three_grains().check(); }), "no error");
}

}  // namespace
}  // namespace furrow::grains_test
