// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/bodies/mesh_bodies.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "furrow/core/error.h"
#include "furrow/geometry/meshes/wheel_mesh.h"
#include "tests/support/checkpoints.h"
#include "tests/support/error_of.h"
#include "tests/support/meshes.h"
#include "tests/support/words.h"

namespace furrow::mesh_bodies_test {
namespace {

using test::box;
using test::error_of;
using test::solid;
using ::testing::HasSubstr;

WheelGeometry drum() {
  WheelGeometry wheel;
  wheel.diameter = 0.3;
  wheel.width = 0.1;
  return wheel;
}

std::unique_ptr<RigidWheel> wheel_of(const Surface& surface, const std::string& line) {
  const Options options =
      mesh_wheel_schema("fix wheel/mesh").read(test::words("file wheel.stl " + line));
  std::vector<std::string> warnings;
  return make_mesh_wheel(options, solid(surface, "wheel.stl"), warnings);
}

std::string refusal(const Surface& surface, const std::string& line) {
  return error_of<InputError>([&] { wheel_of(surface, line); });
}

/// As a CAD program has it: in millimetres, with the axle along z and away from the origin.
Surface drawn(Surface surface) {
  const Matrix3X metres = surface.x;
  surface.x.row(0) = 1e3 * metres.row(0);
  surface.x.row(1) = -1e3 * metres.row(2);
  surface.x.row(2) = 1e3 * metres.row(1);
  surface.x.colwise() += Vector3(100, 200, -50);
  return surface;
}
const std::string as_drawn = "scale 0.001 origin 100 200 -50 axis 0 0 1 ";

// Closed form: a uniform drum, up to the deviation of its polygon from the circle.
TEST(MeshWheel, UniformDrumHasTheClosedFormMassAndInertia) {
  const auto wheel =
      wheel_of(drawn(make_wheel_mesh(drum())), as_drawn + "density 2700 axle 0 0 0.4");
  const double mass = 2700 * pi * 0.15 * 0.15 * 0.1;
  const HubParameters& hub = wheel->parameters().hub;
  EXPECT_NEAR(hub.inertia.mass, mass, 1e-10 * mass);
  EXPECT_NEAR(hub.inertia.axial, 0.5 * mass * 0.0225, 1e-5 * mass * 0.0225);
  EXPECT_NEAR(hub.inertia.diametral, mass * (0.0675 + 0.01) / 12.0, 1e-5 * mass * 0.0225);
  EXPECT_EQ(wheel->centre(), Vector3(0, 0, 0.4));
  EXPECT_NEAR(wheel->nominal_width(), 0.1, 1e-12);
}

TEST(MeshWheel, MillimetresAreConvertedToMetres) {
  const Surface made = make_wheel_mesh(drum());
  const auto wheel = wheel_of(drawn(made), as_drawn + "mass 5");
  EXPECT_LT((wheel->surface().x - made.x).cwiseAbs().maxCoeff(), 1e-14);
  // the largest radius is that of the polygon's nodes
  EXPECT_NEAR(wheel->nominal_radius(), 0.15, 0.15 * std::pow(2 * pi / 64, 2) / 11.0);
  EXPECT_NEAR(wheel->lowest_point(), -wheel->nominal_radius(), 1e-15);
}

TEST(MeshWheel, KeywordsSetNominalRadiusAndInertia) {
  WheelGeometry geometry = drum();
  geometry.grousers = {12, 0.02, 0.008, 0.0};
  const auto wheel =
      wheel_of(make_wheel_mesh(geometry), "radius 0.15 mass 5 inertia 0.06 inertia_diametral 0.04");
  EXPECT_DOUBLE_EQ(wheel->nominal_radius(), 0.15);
  EXPECT_NEAR(wheel->lowest_point(), -0.15, 1e-15);
  EXPECT_LT(wheel->surface().bounds().first.z(), -0.168);
  EXPECT_EQ(wheel->parameters().hub.inertia.axial, 0.06);
  EXPECT_EQ(wheel->parameters().hub.inertia.diametral, 0.04);
}

TEST(MeshWheel, RestartContinuesAndRefusesAnotherRadius) {
  const Surface surface = make_wheel_mesh(drum());
  const auto one = wheel_of(surface, "mass 5"), two = wheel_of(surface, "mass 5"),
             other = wheel_of(surface, "mass 5 radius 0.14");
  one->prescribe(Coordinate::spin, 3.0);
  one->advance(0.01);
  test::hand_over(*one, *two);
  one->advance(0.01);
  two->advance(0.01);
  EXPECT_EQ(one->surface().x, two->surface().x);
  EXPECT_THAT(error_of([&] { test::hand_over(*one, *other); }), HasSubstr("diameter is 0.28"));
}

TEST(MeshWheel, BadMeshesAndKeysAreRefusedWithTheRemedy) {
  const Surface wheel = make_wheel_mesh(drum());
  Surface shifted = wheel, open = wheel, half = wheel;
  shifted.x.row(0).array() += 0.05;
  open.triangles.pop_back();
  half.x *= 0.5;
  const struct {
    Surface surface;
    std::string line;
    const char* message;
  } cases[] = {
      {drawn(wheel), "mass 5",
       "fix wheel/mesh, keyword 'scale' is 1 m, and wheel.stl spans 300.2 m with it; allowed: a "
       "size of 0.001 to 5 m; write 'scale 0.001 origin 100 200 -50 axis 0 0 1'"},
      {wheel, "mass 5 scale 0.001", "write 'scale 1 origin 0 0 0 axis 0 1 0'"},
      {open, "mass 5", "has an edge without a neighbour: the surface is open there"},
      {shifted, "mass 5",
       "fix wheel/mesh, keyword 'origin' puts the axle 0.05 m from the centre of mass; allowed: at "
       "most 0.004"},
      {shifted, "mass 5", "write 'scale 1 origin 0.05 0 0 axis 0 1 0', or give"},
      {drawn(wheel), "mass 5 scale 0.001 origin 100 200 -50",
       "fix wheel/mesh, keyword 'axis' is no axis of revolution of the mesh"},
      {drawn(wheel), "mass 5 scale 0.001 origin 100 200 -50",
       "write 'scale 0.001 origin 100 200 -50 axis 0 0 1', or give mass and inertia"},
      {wheel, "mass 5 axis 0 0 0", "keyword 'axis' is 0 0 0; allowed: a direction"},
      {wheel, "",
       "fix wheel/mesh, keyword 'mass' is missing; allowed: either mass or density; the volume of "
       "the mesh is 0.00706858 m^3"},
      {wheel, "mass 5 density 2700", "keyword 'mass' is given with a density"},
      {wheel, "mass 5 radius 0.2",
       "keyword 'radius' is 0.2 m; allowed: at most 0.150121 m, the largest distance"},
      {wheel, "mass 5 inertia 0.2", "keyword 'inertia' is 0.2 kg m^2; allowed: at most"},
  };
  for (const auto& one : cases) EXPECT_THAT(refusal(one.surface, one.line), HasSubstr(one.message));
  // its mass and inertia are given: it may be out of balance
  EXPECT_EQ(refusal(shifted, "mass 5 inertia 0.06"), "no error");
}

/// Tip at the origin, pointing down; a ring of n nodes at the base.
Surface cone(double angle, double diameter, int n) {
  Surface surface;
  surface.resize(static_cast<std::size_t>(n) + 2);
  const double height = 0.5 * diameter / std::tan(0.5 * angle);
  surface.x.col(1) = Vector3(0, 0, height);
  for (int i = 0; i < n; ++i) {
    const double turn = 2 * pi * i / n;
    surface.x.col(i + 2) =
        Vector3(0.5 * diameter * std::cos(turn), 0.5 * diameter * std::sin(turn), height);
    surface.triangles.push_back({0, 2 + (i + 1) % n, 2 + i});
    surface.triangles.push_back({1, 2 + i, 2 + (i + 1) % n});
  }
  return surface;
}

std::unique_ptr<RigidPlate> plate_of(const Surface& surface, const std::string& line) {
  const Options options =
      mesh_plate_schema("fix plate/mesh").read(test::words("file cone.stl " + line));
  return make_mesh_plate(options, solid(surface, "cone.stl"));
}

// A cone of 30 degrees: its base is the area of the pressure.
TEST(MeshPlate, PressureIsForceOverTheBaseArea) {
  const int n = 48;
  const auto body = plate_of(cone(radians(30), 0.02, n), "centre 0.1 0.2 0.3");
  const double base = 0.5 * n * 1e-4 * std::sin(2 * pi / n);
  body->prescribe(Vector3(0.3, 0, -0.1));
  body->surface().clear_forces();
  body->surface().f.col(0) = Vector3(-2, 0, 5);
  body->advance(0.01);
  EXPECT_NEAR(body->mean_pressure(), 5.0 / base, 1e-9 * 5.0 / base);
  EXPECT_LT((body->surface().bounds().first - Vector3(0.093, 0.19, 0.299)).norm(), 1e-12);
  EXPECT_NEAR(body->energy_budget().contact_work, 0.01 * (-0.6 - 0.5), 1e-15);
  EXPECT_NEAR(body->energy_budget().residual(), 0.0, 1e-18);
}

TEST(MeshPlate, KeywordsSetAreaAndUpwardDirection) {
  Surface upside_down = cone(radians(60), 0.02, 12);
  upside_down.x.bottomRows(2) *= -1.0;
  const auto body = plate_of(upside_down, "centre 0 0 0 axis 0 0 -1 area 0.01");
  EXPECT_NEAR(body->surface().bounds().first.z(), 0.0, 1e-15);
  EXPECT_NEAR(body->surface().bounds().second.z(), 0.01 / std::tan(radians(30)), 1e-15);
  body->surface().f(2, 0) = 3.0;
  EXPECT_NEAR(body->mean_pressure(), 300.0, 1e-10);
  EXPECT_THAT(error_of<InputError>([&] { plate_of(upside_down, "centre 0 0 0 scale 1000"); }),
              HasSubstr("fix plate/mesh, keyword 'scale' is 1000 m, and cone.stl spans 20 m"));
}

}  // namespace
}  // namespace furrow::mesh_bodies_test
