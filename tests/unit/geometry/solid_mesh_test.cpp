// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/geometry/meshes/solid_mesh.h"

#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "furrow/core/error.h"
#include "furrow/geometry/meshes/wheel_mesh.h"
#include "tests/support/error_of.h"
#include "tests/support/meshes.h"

namespace furrow::solid_mesh_test {
namespace {

using test::box;
using test::error_of;
using test::joined;
using test::solid;
using test::turned;
using testing::HasSubstr;

const Surface cube = box(Vector3(0, 0, 0), Vector3(1, 1, 1));

// Closed form: a box about its centre.
TEST(MassProperties, BoxFarFromTheOriginHasItsClosedForm) {
  const Vector3 side(0.3, 0.5, 0.7), centre(101, -202, 303);
  const MassProperties of = mass_properties(box(centre - side / 2, centre + side / 2));
  const double volume = side.prod();
  EXPECT_NEAR(of.volume, volume, 1e-12 * volume);
  EXPECT_LT((of.centre - centre).norm(), 1e-11);
  const Matrix3 of_point =
      volume * (centre.squaredNorm() * Matrix3::Identity() - centre * centre.transpose());
  const Matrix3 about_centre =
      volume / 12.0 *
      (side.squaredNorm() * Vector3::Ones() - side.cwiseProduct(side)).asDiagonal().toDenseMatrix();
  EXPECT_LT((of.inertia - of_point - about_centre).norm(), 1e-11 * of_point.norm());
}

// Closed form: a prism on a regular polygon. With more sides it tends to the cylinder of its area.
TEST(MassProperties, PrismConvergesToTheCylinder) {
  WheelGeometry wheel;
  wheel.diameter = 0.6;
  wheel.width = 0.25;
  double last_error = 0.0;
  for (const int segments : {32, 64}) {
    wheel.segments = segments;
    const MassProperties of = mass_properties(make_wheel_mesh(wheel));
    const double area = pi * 0.09, volume = area * wheel.width, turn = 2 * pi / segments;
    const double corner = std::sqrt(2.0 * area / (segments * std::sin(turn)));
    const double axial = volume * corner * corner * (2.0 + std::cos(turn)) / 6.0;
    EXPECT_NEAR(of.volume, volume, 1e-12 * volume);
    EXPECT_LT(of.centre.norm(), 1e-14);
    EXPECT_NEAR(of.inertia(1, 1), axial, 1e-12 * axial);
    const double across = 0.5 * axial + volume * std::pow(wheel.width, 2) / 12.0;
    EXPECT_NEAR(of.inertia(0, 0), across, 1e-12 * across);
    EXPECT_NEAR(of.inertia(2, 2), across, 1e-12 * across);
    EXPECT_LT(std::abs(of.inertia(0, 1)) + std::abs(of.inertia(1, 2)), 1e-15);
    const double error = axial / (volume * 0.09 / 2.0) - 1.0;
    if (last_error > 0.0) {
      EXPECT_NEAR(last_error / error, 16.0, 0.1);
    }
    last_error = error;
  }
}

TEST(SolidMesh, SolidsWithCavitiesAndSeveralPartsAreAccepted) {
  const Surface cavity = turned(box(Vector3(0.2, 0.2, 0.2), Vector3(0.8, 0.8, 0.8))),
                core = box(Vector3(0.4, 0.4, 0.4), Vector3(0.6, 0.6, 0.6)),
                other = box(Vector3(2, 0, 0), Vector3(3, 1, 1));
  for (const Surface& surface :
       {cube, joined(cube, cavity), joined(joined(cube, cavity), core), joined(cube, other)})
    EXPECT_NO_THROW(check_solid(solid(surface)));
  WheelGeometry wheel;
  wheel.diameter = 0.6;
  wheel.width = 0.2;
  wheel.shoulder = 0.03;
  wheel.grousers = {12, 0.02, 0.01, 0.3};
  EXPECT_NO_THROW(check_solid(solid(make_wheel_mesh(wheel))));
}

/// A cube with one fault.
struct BadMesh {
  const char* name;
  Surface surface;
  const char* message;
};

Surface with(const Surface& surface, const std::function<void(Surface&)>& fault) {
  Surface changed = surface;
  fault(changed);
  return changed;
}

class BadSolid : public testing::TestWithParam<BadMesh> {};

TEST_P(BadSolid, FaultySolidIsRefusedWithFacetAndRemedy) {
  EXPECT_THAT(error_of<InputError>([] { check_solid(solid(GetParam().surface)); }),
              HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Meshes, BadSolid,
    testing::Values(
        BadMesh{"HoleOfOneFacet",
                with(cube, [](Surface& s) { s.triangles.erase(s.triangles.begin() + 4); }),
                "part.stl, facet 2 at 0.6667 0.3333 0 has an edge without a neighbour"},
        BadMesh{"TurnedFacet",
                with(cube, [](Surface& s) { std::swap(s.triangles[6][0], s.triangles[6][1]); }),
                "facet 7 at 0.3333 1 0.6667 and its neighbour, facet 10, have opposite "
                "orientations; allowed: corners in "
                "counter-clockwise order, seen from outside; make the normals consistent"},
        BadMesh{"InsideOut", turned(cube),
                "part.stl, facet 1 at 0.3333 0.6667 0 points inwards, as all facets of its shell "
                "do; allowed: corners in counter-clockwise order, seen from outside; flip"},
        BadMesh{"DoubleFacet",
                with(cube, [](Surface& s) { s.triangles.push_back(s.triangles[2]); }),
                "shares an edge with 2 other facets"},
        BadMesh{"FacetOfTwoCorners",
                with(cube,
                     [](Surface& s) {
                       s.triangles.push_back({0, 0, 1});
                     }),
                "facet 13 at 0.3333 0 0 is degenerate"},
        BadMesh{"FacetOnALine",
                with(cube,
                     [](Surface& s) {
                       s.x.col(7) = Vector3(0.5, 0.5, 1.0);
                       s.x.col(6) = Vector3(0.25, 0.25, 1.0);
                     }),
                "facet 4 at 0.25 0.25 1 is degenerate: its three corners lie on a line"},
        BadMesh{"PartsThatOverlap",
                joined(cube, box(Vector3(0.5, 0.3, 0.3), Vector3(1.5, 0.7, 0.7))),
                "which is not its neighbour; allowed: a surface that does not intersect itself; "
                "unite the parts of the solid"},
        BadMesh{"PartsThatOverlapWithFacesInOnePlane",
                joined(cube, box(Vector3(0.5, 0, 0), Vector3(1.5, 1, 1))),
                "which is not its neighbour"},
        BadMesh{"SpikeThroughTheOppositeFace",
                with(cube, [](Surface& s) { s.x.col(7) = Vector3(0.3, 0.4, -0.5); }),
                "meets facet"},
        BadMesh{"SolidInsideASolid",
                joined(cube, box(Vector3(0.2, 0.2, 0.2), Vector3(0.8, 0.8, 0.8))),
                "facet 13 at 0.4 0.6 0.2 belongs to a solid inside another solid"},
        BadMesh{"PartTurnedInsideOut",
                joined(cube, turned(box(Vector3(2, 0, 0), Vector3(3, 1, 1)))),
                "facet 13 at 2.333 0.6667 0 points inwards"},
        BadMesh{"TwoFacetsBackToBack",
                with(cube,
                     [](Surface& s) {
                       s.triangles = {{0, 1, 3}, {0, 3, 1}};
                     }),
                "facet 1 at 0.6667 0.3333 0 is folded onto facet 2; allowed"},
        BadMesh{"FlatSheetOfTwoSides",
                with(cube,
                     [](Surface& s) {
                       s.triangles = {{0, 2, 3}, {0, 3, 1}, {0, 3, 2}, {0, 1, 3}};
                     }),
                "is folded onto facet 4; allowed: a surface that encloses a volume"}),
    [](const auto& mesh) { return mesh.param.name; });

TEST(SolidMesh, AllFaultsAreCounted) {
  Surface surface = joined(cube, box(Vector3(0.5, 0.3, 0.3), Vector3(1.5, 0.7, 0.7)));
  surface.triangles.push_back({0, 0, 1});
  surface.triangles.erase(surface.triangles.begin() + 4);
  const std::string message = error_of<InputError>([&] { check_solid(solid(surface)); });
  EXPECT_THAT(message, HasSubstr("facet 24 at 0.3333 0 0 is degenerate"));
  EXPECT_THAT(message, HasSubstr("or write a repaired mesh with 'furrow-tyre mesh part.stl'; all "
                                 "faults: 1 facets without area, "));
  EXPECT_THAT(message, HasSubstr("edges without a neighbour"));
  EXPECT_THAT(message, HasSubstr("facets that meet others"));
}

}  // namespace
}  // namespace furrow::solid_mesh_test
