// SPDX-License-Identifier: GPL-2.0-or-later
// Hard cases of a wheel on grains: dropped, digging at 90 % slip, soft and stiff grains, a bed so
// thin that grains are caught between wheel and floor, and a cohesive column that collapses. What
// must hold: no grain is lost, every number is finite, momentum is kept, the wheel's energy balance
// closes, and grains hold no more energy than wheel and weight gave them.

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "atom.h"
#include "coupling/wheels/fix_wheel_rigid.h"
#include "modify.h"
#include "tests/coupled/support/scene.h"

namespace furrow::test::wheel_on_bed_hard_cases_test {
namespace {

struct Case {
  const char* name;
  double young, step, depth, slip, drop;  // [Pa], [s], poured height [m], -, [m]
};

constexpr const char* hertz = "model hertz tangential history";

void make_bed(Scene& scene, const Case& c) {
  scene.granular_box(Vector3(-0.13, -0.06, -0.01), Vector3(0.13, 0.06, 0.3), 0.003);
  // LIGGGHTS asks for this word below 5 MPa
  if (c.young < 5e6) scene.command("soft_particles yes");
  scene.contact_properties(c.young, 0.3, 0.3, 0.5);
  scene.grains_fall(hertz, c.step);
  scene.flat_walls(hertz,
                   {"xplane -0.12", "xplane 0.12", "yplane -0.05", "yplane 0.05", "zplane 0"});
  scene.pour(0.004, fmt::format("block -0.12 0.12 -0.05 0.05 0 {}", c.depth),
             "volumefraction_region 0.3");
  scene.commands(
      fmt::format("fix calm all viscous 0.02\nthermo 100000\nrun {}\nunfix calm\nunfix ins",
                  static_cast<int>(0.45 / c.step)));
}

class HardCase : public testing::TestWithParam<Case> {};

TEST_P(HardCase, BedKeepsGrainsMomentumAndEnergy) {
  const Case c = GetParam();
  Scene scene;
  make_bed(scene, c);
  const double grains = scene.sum(scene.lammps().atom->nlocal), mass = scene.grain_mass(),
               level = scene.top_of_grains();
  scene.command(
      fmt::format("fix wheel all wheel/rigid diameter 0.1 width 0.05 shoulder 0.005 mass 0.5 "
                  "inertia 6e-4 segments 48 axle -0.05 0 {:.9f}",
                  level + 0.052 + c.drop));
  scene.command(
      fmt::format("fix rig all wheel/rig wheel wheel load_force 12 speed 0.1 mode slip slip {} "
                  "settle_time 0.3 load_ramp_time {} "
                  "accelerate_time 0.1 ground_level {:.9f} damping 2",
                  c.slip, c.drop > 0.0 ? 0.001 : 0.1, level));
  scene.wall_of_body("wheel", hertz, "tread");
  const RigidWheel& wheel =
      dynamic_cast<coupling::FixWheelRigid*>(scene.lammps().modify->find_fix_id("wheel"))->wheel();
  scene.command(fmt::format("run {}", static_cast<int>(0.9 / c.step)));
  const EnergyBudget budget = wheel.energy_budget();
  const double scale = std::max(std::abs(budget.contact_work), std::abs(budget.load_work)),
               energy = scene.grain_kinetic_energy();
  const coupling::MomentumAudit audit = scene.system().audit(wheel);
  const double left = scene.sum(scene.lammps().atom->nlocal);
  EXPECT_EQ(left, grains);
  EXPECT_TRUE(std::isfinite(energy));
  EXPECT_NEAR(scene.grain_mass(), mass, 1e-12 * mass);
  EXPECT_LT(std::abs(budget.residual()) / scale, 1e-9);
  EXPECT_LT(audit.force, 1e-10);
  // The wheel and gravity are the only sources: grains cannot hold more than what the wheel gave
  // and what they could fall.
  EXPECT_LT(energy, std::abs(budget.contact_work) + mass * 9.81 * level);
}

INSTANTIATE_TEST_SUITE_P(
    Wheel, HardCase,
    testing::Values(
        Case{"dropped from 50 mm", 5e6, 4e-5, 0.08, 0.0, 0.05},
        Case{"slip 90 %", 5e6, 4e-5, 0.08, 0.9, 0.0}, Case{"stiff", 1e8, 9e-6, 0.03, 0.2, 0.0},
        Case{"thin: grains caught on the floor", 5e6, 4e-5, 0.025, 0.5, 0.0},
        // A tenth of a megapascal: grains overlap by a quarter of their diameter under the wheel
        Case{"very soft", 1e5, 2e-4, 0.08, 0.2, 0.0}),
    [](const auto& entry) { return fmt::format("case_{}", entry.index); });

/// A column of sticky grains whose side is taken away falls until it rests: kinetic energy never
/// exceeds what gravity gives.
TEST(HardCases, CohesiveColumnCollapses) {
  Scene scene;
  const double step = 2e-5;
  scene.granular_box(Vector3(-0.6, -0.6, -0.01), Vector3(0.6, 0.6, 0.2), 0.003);
  scene.contact_properties(5e6, 0.3, 0.3, 0.5);
  scene.command(
      "fix stick all property/global cohesionEnergyDensity peratomtypepair 2 5e4 5e4 5e4 5e4");
  const std::string contact = "model hertz tangential history cohesion sjkr2";
  scene.grains_fall(contact, step);
  scene.commands(
      fmt::format("fix floor all wall/gran {0} primitive type 1 zplane 0\n"
                  "fix side all wall/gran {0} primitive type 1 zcylinder 0.04 0 0",
                  contact));
  scene.pour(0.004, "cylinder z 0 0 0.04 0 0.19", "volumefraction_region 0.28");
  scene.commands(
      "fix calm all viscous 0.02\nthermo 100000\nrun 20000\nunfix "
      "calm\nunfix ins\nunfix side");
  const double grains = scene.sum(scene.lammps().atom->nlocal), mass = scene.grain_mass(),
               top = scene.top_of_grains();
  double liveliest = 0.0;
  scene.at_end_of_step([&] { liveliest = std::max(liveliest, scene.grain_kinetic_energy()); });
  scene.command("run 25000");
  const double energy = scene.grain_kinetic_energy();
  EXPECT_EQ(scene.sum(scene.lammps().atom->nlocal), grains);
  EXPECT_LT(liveliest, mass * 9.81 * top / 2);
  EXPECT_LT(energy, 0.2 * liveliest);
}

}  // namespace
}  // namespace furrow::test::wheel_on_bed_hard_cases_test
