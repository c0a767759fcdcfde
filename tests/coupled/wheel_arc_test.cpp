// SPDX-License-Identifier: GPL-2.0-or-later
// fix wheel/arc on both grounds: the stresses of all sectors are the force and the torque of the
// ground on the wheel, and rim and ground slide over one another as the wheel's slip says.

#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "coupling/wheels/fix_wheel_rigid.h"
#include "furrow/io/formats/csv_file.h"
#include "modify.h"
#include "tests/coupled/support/sand.h"
#include "tests/coupled/support/scene.h"
#include "update.h"

namespace furrow::test::wheel_arc_test {
namespace {

constexpr double radius = 0.05, width = 0.05, slip = 0.3, speed = 0.3;
constexpr int sectors = 720;

void add_wheel(Scene& scene, double level) {
  scene.commands(fmt::format(
      "fix wheel all wheel/rigid diameter {} width {} shoulder 0 mass 0.5 inertia 6e-4 segments "
      "180 "
      "axle -0.05 0 {:.9f}\n"
      "fix rig all wheel/rig wheel wheel load_force 8 speed {} mode slip slip {} settle_time 0.1 "
      "accelerate_time 0.05 ground_level {:.9f} damping 10 release in_air",
      2.0 * radius, width, level + radius + 0.001, speed, slip, level));
}

/// Compares force and torque on the wheel, mean over an interval, from its surface and from its
/// arc. The rim must slide on the ground by more than a share of its speed on ground at rest.
void compare(Scene& scene, int settling, int steps, double minimum_sliding) {
  const std::string folder =
      testing::TempDir() + fmt::format("wheel_arc_{}_{}", scene.ranks(), scene.rank());
  scene.command(fmt::format("run {}", settling));
  scene.command(fmt::format("fix arc all wheel/arc wheel wheel folder {} every {} sectors {}",
                            folder, settling + steps, sectors));
  const RigidWheel& wheel =
      dynamic_cast<coupling::FixWheelRigid*>(scene.lammps().modify->find_fix_id("wheel"))->wheel();
  Vector3 force = Vector3::Zero();
  double torque = 0.0;
  scene.at_end_of_step([&] {
    force += wheel.surface().total_force() / steps;
    torque -= wheel.surface().total_moment(wheel.centre()).y() / steps;
  });
  scene.command(fmt::format("run {}", steps));
  if (scene.rank() != 0) return;

  const CsvTable table = CsvTable::read(folder + "/arc.csv");
  std::filesystem::remove_all(folder);
  ASSERT_EQ(table.rows(), std::size_t(sectors));
  const std::vector<double> angle = table.numbers("angle"), normal = table.numbers("normal_stress"),
                            shear = table.numbers("shear_stress"),
                            sliding = table.numbers("slip_velocity");
  const double area = pi / sectors * radius * width;
  double along = 0.0, up = 0.0, twist = 0.0, slid = 0.0, pressed = 0.0;
  for (std::size_t s = 0; s < table.rows(); ++s) {
    const double c = std::cos(angle[s] * pi / 180.0), n = std::sin(angle[s] * pi / 180.0);
    along += area * (shear[s] * c - normal[s] * n);
    up += area * (shear[s] * n + normal[s] * c);
    twist += area * radius * shear[s];
    slid += normal[s] * sliding[s];
    pressed += normal[s];
  }
  EXPECT_NEAR(force.z(), 8.0, 2.0);
  EXPECT_NEAR(up, force.z(), 0.003 * force.norm());
  EXPECT_NEAR(along, force.x(), 0.003 * force.norm());
  EXPECT_GT(torque, 0.1 * radius * force.norm());  // friction drives it
  // the polygon's contacts lie a little within the circle
  EXPECT_NEAR(twist, torque, 0.01 * torque);
  // the rim goes backwards over the ground, less fast than over ground at rest where that gives way
  const double rim = speed * slip / (1.0 - slip);  // [m/s]
  EXPECT_GT(slid / pressed, minimum_sliding * rim);
  EXPECT_LT(slid / pressed, 1.3 * rim);
}

TEST(WheelArc, ArcStressesSumToForceAndTorqueOnAContinuum) {
  Scene scene;
  scene.granular_box(Vector3(-1, -1, -1), Vector3(1, 1, 1), 0.05);
  scene.commands("atom_modify sort 0 0\ntimestep 1e-4");
  add_wheel(scene, 0.06);
  scene.commands(fmt::format(
      "fix soil all terrain/continuum material {}/inputs/materials/fresh_snow.yaml length 0.4 "
      "width "
      "0.12 depth 0.06 surface 0.06 cell 0.02 symmetry yes follow wheel clearance_above 0.2\n"
      "fix touch all contact/continuum body wheel terrain soil friction 0.3 slip_length 0\nthermo "
      "100000",
      FURROW_SOURCE_DIR));
  compare(scene, 2000, 1500, 0.2);
}

TEST(WheelArc, ArcStressesSumToForceAndTorqueOnGrains) {
  Scene scene;
  make_sand_bed(scene);
  add_wheel(scene, 0.075);
  scene.wall_of_body("wheel", hertz, "tread");
  compare(scene, 6000, 2000, 0.0);  // grains stick and roll
}

}  // namespace
}  // namespace furrow::test::wheel_arc_test
