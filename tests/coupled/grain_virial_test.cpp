// SPDX-License-Identifier: GPL-2.0-or-later
// Stress of grains by their contacts: a column at rest has it in closed form.

#include "coupling/output/grain_virial.h"

#include <gtest/gtest.h>

#include "coupling/output/gather_grains.h"
#include "tests/coupled/support/scene.h"

namespace furrow::test::grain_virial_test {
namespace {

constexpr double radius = 0.01, density = 2000.0, gravity = 9.81;

/// Three grains, one upon the other on a floor, at rest after 0.4 s.
void stand_a_column(Scene& scene) {
  scene.granular_box(Vector3(-0.1, -0.1, 0.0), Vector3(0.1, 0.1, 0.2), 0.004);
  scene.contact_properties(5e6, 0.3, 0.3, 0.5);
  scene.commands(
      "pair_style gran model hertz tangential history\n"
      "pair_coeff * *\n"
      "timestep 1e-5\n"
      "fix down all gravity 9.81 vector 0 0 -1\n"
      "fix floor all wall/gran model hertz tangential history primitive type 1 zplane 0\n"
      "fix move all nve/sphere");
  for (int k = 0; k < 3; ++k)
    scene.command("create_atoms 1 single 0.003 0.003 " +
                  std::to_string((2 * k + 1) * radius * 0.9999));
  scene.command("set group all diameter 0.02 density 2000");
  coupling::add_grain_virial(scene.lammps());
  scene.command("run 40000");
}

TEST(GrainVirial, StressInAColumnIsTheWeightAbove) {
  Scene scene;
  stand_a_column(scene);
  EXPECT_FALSE(coupling::grain_virial(scene.lammps()));  // nobody had asked

  scene.at_end_of_step([&] { coupling::ask_for_grain_virial(scene.lammps()); });
  scene.command("run 10");
  const std::optional<Matrix3X> local = coupling::grain_virial(scene.lammps());
  ASSERT_TRUE(local);
  const Grains grains = coupling::gather_grains(scene.lammps(), 0.0, local);
  if (scene.rank() != 0) return;
  ASSERT_EQ(grains.virial.cols(), 3);
  const double weight = gravity * density * 4.0 / 3.0 * pi * radius * radius * radius;
  for (Eigen::Index i = 0; i < 3; ++i) {
    // contacts carry the weight of what is above them; half of force times distance for each grain
    const int below = static_cast<int>(grains.id[static_cast<std::size_t>(i)]) - 1;
    const double contacts = below == 0 ? 2.0 : below == 1 ? 3.0 : 1.0;
    EXPECT_NEAR(grains.virial(2, i) / (-0.5 * contacts * weight * 2.0 * radius), 1.0, 5e-3);
    EXPECT_NEAR(grains.virial(0, i), 0.0, 1e-6 * weight * radius);
  }
}

/// The set-up computes damping with velocities of the full step.
TEST(GrainVirial, RunOfZeroStepsHasNoVirial) {
  Scene scene;
  stand_a_column(scene);
  scene.command("compute seen all stress/atom pair");
  scene.command(
      "dump seen all custom 10 /dev/null id c_seen[1]");  // its set-up computes the stress
  scene.command("run 0");
  EXPECT_FALSE(coupling::grain_virial(scene.lammps()));
}

}  // namespace
}  // namespace furrow::test::grain_virial_test
