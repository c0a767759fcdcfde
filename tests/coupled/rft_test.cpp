// SPDX-License-Identifier: GPL-2.0-or-later
// Scripts with bodies in sand by resistive force theory. A plate has its closed form. The work of a
// wheel from a mesh is that of the sand. A wheel with grousers slips on slopes.

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "coupling/drive/fix_wheel_rig.h"
#include "fix.h"
#include "modify.h"
#include "furrow/statistics/history.h"
#include "tests/coupled/support/scene.h"

namespace furrow::test::rft_test {
namespace {

constexpr double xi = 1e6;  // [N/m^3]

double output(Scene& scene, const char* id, int entry) {
  return scene.lammps().modify->find_fix_id(const_cast<char*>(id))->compute_vector(entry - 1);
}

double channel(Scene& scene, const char* name) {
  const auto& fix = dynamic_cast<coupling::FixWheelRig&>(
      *scene.lammps().modify->find_fix_id(const_cast<char*>("rig")));
  const History channels(WheelRig::channels());
  return fix.rig().measure(scene.system().time())[channels.index(name)];
}

void begin(Scene& scene, double step) {
  scene.granular_box(Vector3(-1.0, -0.5, -0.5), Vector3(3.0, 0.5, 1.0), 0.05);
  scene.command("atom_modify sort 0 0");  // no grains, no bins
  scene.commands(
      fmt::format("timestep {}\nthermo 100000\n"
                  "fix soil all terrain/scm length 3 width 0.6 centre 0.9 0 cell 0.05",
                  step));
}

/// The force is that of 0.875 xi at the depth of the step before.
TEST(Rft, PlateForceIsProportionalToDepth) {
  Scene scene;
  begin(scene, 1e-3);
  scene.commands(fmt::format(
      "fix plate all plate/rigid shape square size 0.1 thickness 0.05 centre 0 0 0 speed 0.02 "
      "accelerate_time 0 ground_level 0\n"
      "fix touch all contact/rft body plate terrain soil xi {} friction 0\nrun 1001",
      xi));
  const double depth = output(scene, "touch", 6), force = output(scene, "touch", 3);
  EXPECT_NEAR(depth, 0.02, 1e-9);
  EXPECT_NEAR(force, 0.875 * xi * depth * 0.01, 1e-3 * force);
  EXPECT_NEAR(output(scene, "plate", 2), force, 1e-9 * force);
  EXPECT_NEAR(output(scene, "touch", 7), 0.5 * force * depth, 0.06 * force * depth);
}

TEST(Rft, WheelFromAMeshCarriesItsLoadAndDissipatesItsWork) {
  constexpr double load = 150.0, slip = 0.2;
  Scene scene;
  begin(scene, 2e-4);
  scene.commands(fmt::format(
      "fix wheel all wheel/mesh file {}/inputs/meshes/rover_wheel.stl scale 0.001 axis 0 0 1 "
      "radius "
      "0.15 grousers 24 mass 5 axle 0 0 0.164\n"
      "fix rig all wheel/rig wheel wheel load_force {} speed 0.2 mode slip slip {} settle_time 0.3 "
      "accelerate_time 0.2 ground_level 0 damping 200\n"
      "fix touch all contact/rft body wheel terrain soil xi {} friction 0.4\nrun 5000",
      FURROW_SOURCE_DIR, load, slip, xi));
  const auto loss = [&] { return output(scene, "touch", 7) + output(scene, "touch", 8); };
  const auto given = [&] { return -scene.body("wheel").energy_budget().contact_work; };
  const double loss_before = loss(), given_before = given();
  double force = 0.0, driven = 0.0;
  constexpr int parts = 500;
  for (int part = 0; part < parts; ++part) {
    scene.command("run 10 post no");
    force += channel(scene, "force_z") / parts;
    driven += output(scene, "touch", 1) / parts;
  }
  EXPECT_NEAR(force, load, 0.02 * load);
  EXPECT_GT(driven, 0.0);
  EXPECT_NEAR(channel(scene, "slip"), slip, 1e-6);
  const double work = given() - given_before;
  EXPECT_GT(work, 0.0);
  EXPECT_NEAR(loss() - loss_before, work, 0.02 * work);
  const EnergyBudget budget = scene.body("wheel").energy_budget();
  EXPECT_NEAR(budget.residual(), 0.0, 1e-2 * work);
}

/// Slip of a wheel that climbs, over its last second.
double slip_on(double slope) {
  constexpr double step = 5e-4, spin = 0.8;
  Scene scene;
  begin(scene, step);
  scene.commands(fmt::format(
      "fix wheel all wheel/rigid diameter 0.45 width 0.2 mass 17.5 inertia 0.44 axle 0 0 0.257 "
      "grousers 24 grouser_height 0.03 grouser_thickness 0.005\n"
      "fix rig all wheel/rig wheel wheel load_mass 17.5 mode spin spin_rate {} travel free slope "
      "{} "
      "settle_time 0.5 accelerate_time 0.3 ground_level 0 damping 300\n"
      "fix touch all contact/rft body wheel terrain soil xi {} friction 0.5\nrun 2600",
      spin, slope, xi));
  const double start = scene.body("wheel").surface().x.row(0).mean();
  scene.command("run 2000");
  const double travel = scene.body("wheel").surface().x.row(0).mean() - start;
  return 1.0 - travel / (1.0 * spin * 0.225);
}

TEST(Rft, WheelWithGrousersSlipsMoreOnASteeperSlope) {
  const double level = slip_on(0.0), gentle = slip_on(8.0), steep = slip_on(16.0);
  EXPECT_LT(level, gentle - 0.005);
  EXPECT_LT(gentle, steep - 0.01);
  EXPECT_LT(std::abs(level), 0.2);
}

}  // namespace
}  // namespace furrow::test::rft_test
