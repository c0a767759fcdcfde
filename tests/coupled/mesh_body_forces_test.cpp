// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies from mesh files: forces and motion are those of the built-in body of the same shape, for
// any triangles.

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "furrow/geometry/meshes/wheel_mesh.h"
#include "modify.h"
#include "tests/coupled/support/scene.h"
#include "tests/support/meshes.h"

namespace furrow::test::mesh_body_forces_test {
namespace {

constexpr double load = 40.0;  // [N]

/// A file that all ranks read.
std::string stl_of(Scene& scene, const Surface& surface) {
  const std::string path = fmt::format("mesh_body_forces_test_{}.stl", scene.ranks());
  if (scene.rank() == 0) write_stl(path, surface);
  scene.sum(0.0);  // a barrier
  return path;
}

double output(Scene& scene, const char* fix, int entry) {
  return scene.lammps().modify->find_fix_id(fix)->compute_vector(entry - 1);
}

struct Outcome {
  Vector3 force;  // of the ground [N], mean of the last steps
  double height;  // of the axle, or of the lower face [m]
};

void add_snow(Scene& scene, const char* body, const char* follow) {
  scene.command(fmt::format(
      "fix soil all terrain/continuum material {}/inputs/materials/fresh_snow.yaml length 0.48 "
      "width 0.32 depth 0.12 surface 0.12 cell 0.04 clearance_above 0.2 {}",
      FURROW_SOURCE_DIR, follow));
  scene.command(
      fmt::format("fix touch all contact/continuum body {} terrain soil friction 0.3", body));
}

/// Mean of the contact's force over the steps of a run.
Outcome run(Scene& scene, int steps, const char* fix) {
  Vector3 sum = Vector3::Zero();
  scene.at_end_of_step([&] { sum += scene.body(fix).surface().total_force(); });
  scene.command(fmt::format("run {}", steps));
  const auto [lower, upper] = scene.body(fix).surface().bounds();
  return {sum / steps, 0.5 * (lower.z() + upper.z())};
}

/// Rolls with slip on snow.
Outcome roll(Scene& scene, const std::string& wheel) {
  scene.granular_box(Vector3(-0.5, -0.5, -0.5), Vector3(0.9, 0.5, 0.9), 0.05);
  scene.commands("atom_modify sort 0 0\ntimestep 2e-4\nthermo 100000");
  scene.command(wheel);
  scene.command(
      fmt::format("fix rig all wheel/rig wheel wheel load_force {} speed 0.5 mode slip slip 0.2 "
                  "settle_time 0.05 accelerate_time 0.05 ground_level 0.12 damping 50",
                  load));
  add_snow(scene, "wheel", "symmetry yes follow wheel");
  scene.command("run 600");
  return run(scene, 200, "wheel");
}

void expect_equal(const Outcome& one, const Outcome& other, double tolerance) {
  EXPECT_GT(one.force.z(), 0.5 * load);
  EXPECT_LT((one.force - other.force).norm(), tolerance * one.force.norm());
  EXPECT_NEAR(one.height, other.height, tolerance * 0.01);
}

class WheelMesh : public ::testing::TestWithParam<int> {};

// The same triangles, which the file has with all digits.
TEST_P(WheelMesh, MeshOfAWheelHasTheForcesOfTheRigidWheel) {
  WheelGeometry geometry;
  geometry.diameter = 0.2;
  geometry.width = 0.08;
  geometry.shoulder = 0.01;
  geometry.segments = 48;
  if (GetParam() > 0) geometry.grousers = {GetParam(), 0.01, 0.006, 0.0};
  const std::string common = "mass 4 inertia 0.02 inertia_diametral 0.015 axle 0 0 0.235";
  Scene built_in;
  const std::string bars =
      GetParam() > 0
          ? fmt::format("grousers {} grouser_height 0.01 grouser_thickness 0.006", GetParam())
          : "";
  const Outcome expected =
      roll(built_in, fmt::format("fix wheel all wheel/rigid diameter 0.2 width 0.08 shoulder 0.01 "
                                 "segments 48 {} {}",
                                 bars, common));
  Scene from_file;
  const Outcome found =
      roll(from_file, fmt::format("fix wheel all wheel/mesh file {} radius 0.1 {}",
                                  stl_of(from_file, make_wheel_mesh(geometry)), common));
  expect_equal(expected, found, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Grousers, WheelMesh, ::testing::Values(0, 16), [](const auto& grousers) {
  return grousers.param == 0 ? "smooth" : "grousers";
});

Outcome press(Scene& scene, const std::string& plate, bool on_grains) {
  scene.granular_box(Vector3(-0.5, -0.5, 0.0), Vector3(0.5, 0.5, 0.5), 0.002);
  scene.contact_properties(5e6, 0.3, 0.5, 0.4);
  scene.commands("timestep 1e-4\nthermo 100000");
  if (!on_grains) scene.command("atom_modify sort 0 0");
  if (on_grains) {
    scene.commands(
        "pair_style gran model hertz tangential history\npair_coeff * *\n"
        "lattice sc 0.0081\nregion layer block -0.06 0.06 -0.06 0.06 0.105 0.12 units box\n"
        "create_atoms 1 region layer\nset group all diameter 0.008 density 2500\n"
        "fix floor all wall/gran model hertz tangential history primitive type 1 zplane 0.1\n"
        "fix move all nve/sphere");
  }
  scene.command(plate + " speed 0.2 accelerate_time 0 ground_level 0.12");
  if (on_grains)
    scene.commands(
        "fix skin all mesh/body body plate type 1\n"
        "fix face all wall/gran/body model hertz tangential history mesh n_meshes 1 meshes skin");
  else
    add_snow(scene, "plate", "");
  scene.command("run 300");
  return run(scene, 100, "plate");
}

/// The lower face of 128 triangles, and of two.
void expect_the_plate_of_twelve_facets(bool on_grains) {
  Scene built_in, from_file;
  const Outcome expected = press(built_in,
                                 "fix plate all plate/rigid shape square size 0.08 thickness 0.05 "
                                 "elements 8 centre 0 0 0.1225",
                                 on_grains);
  const std::string file = stl_of(from_file, box(Vector3(-40, -40, 0), Vector3(40, 40, 50)));
  const Outcome found =
      press(from_file,
            fmt::format("fix plate all plate/mesh file {} scale 0.001 centre 0 0 0.1225", file),
            on_grains);
  EXPECT_NEAR(output(from_file, "plate", 1), output(built_in, "plate", 1), 1e-12);
  for (const int entry : {2, 3})
    EXPECT_NEAR(output(from_file, "plate", entry), output(built_in, "plate", entry),
                1e-6 * output(built_in, "plate", entry));
  expect_equal(expected, found, 1e-6);
}

TEST(PlateMesh, TwelveFacetsHaveTheForcesOfThePlateOnAContinuum) {
  expect_the_plate_of_twelve_facets(false);
}

TEST(PlateMesh, TwelveFacetsHaveTheForcesOfThePlateOnGrains) {
  expect_the_plate_of_twelve_facets(true);
}

}  // namespace
}  // namespace furrow::test::mesh_body_forces_test
