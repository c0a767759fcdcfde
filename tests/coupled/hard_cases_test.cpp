// SPDX-License-Identifier: GPL-2.0-or-later
// Hard cases of a wheel on grains: dropped, digging at 90 % slip, soft and stiff grains, a bed so
// thin that grains are caught between wheel and floor, and a cohesive column that collapses. What
// must hold: no grain is lost, every number is finite, momentum is kept, the wheel's energy balance
// closes, and grains lose energy only.

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "atom.h"
#include "coupling/bodies/fix_wheel_rigid.h"
#include "modify.h"
#include "tests/coupled/support/scene.h"
#include "tests/support/max_error.h"

namespace furrow::test::hard_cases_test {
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
  scene.commands(fmt::format(
      "pair_style gran {}\npair_coeff * *\ntimestep {}\nfix weight all gravity 9.81 vector 0 0 -1",
      hertz, c.step));
  for (const char* wall :
       {"xplane -0.12", "xplane 0.12", "yplane -0.05", "yplane 0.05", "zplane 0"})
    scene.command(fmt::format("fix {0:.1}{1} all wall/gran {2} primitive type 1 {0}", wall,
                              wall[7] == '-' ? 1 : 2, hertz));
  scene.commands(
      fmt::format("fix pts all particletemplate/sphere 15485863 atom_type 1 density constant 2500 "
                  "radius constant 0.004\n"
                  "fix pdd all particledistribution/discrete 32452843 1 pts 1.0\n"
                  "region fill block -0.12 0.12 -0.05 0.05 0 {} units box\n"
                  "fix ins all insert/pack seed 32452867 distributiontemplate pdd insert_every "
                  "once overlapcheck yes all_in yes "
                  "volumefraction_region 0.3 region fill\n"
                  "fix move all nve/sphere\nfix calm all viscous 0.02\nthermo 100000\nrun "
                  "{}\nunfix calm\nunfix ins",
                  c.depth, static_cast<int>(0.45 / c.step)));
}

double top_of(Scene& scene) {
  const LAMMPS_NS::Atom& atom = *scene.lammps().atom;
  double top = 0.0;
  for (int i = 0; i < atom.nlocal; ++i) top = std::max(top, atom.x[i][2] + atom.radius[i]);
  return scene.max(top);
}

/// Kinetic energy of all grains and that of their weight [J].
double energy_of_grains(Scene& scene) {
  const LAMMPS_NS::Atom& atom = *scene.lammps().atom;
  double height = 0.0;
  for (int i = 0; i < atom.nlocal; ++i) height += atom.rmass[i] * atom.x[i][2];
  return scene.grain_kinetic_energy() + 9.81 * scene.sum(height);
}

/// By how much an energy that should only fall rises above what it has once been.
class EnergyRise {
 public:
  void add(double energy) {
    lowest_ = std::min(lowest_, energy);
    rise_.add(energy - lowest_);
  }
  double max() const { return rise_.max(); }

 private:
  double lowest_ = std::numeric_limits<double>::infinity();
  MaxError rise_;
};

class HardCase : public testing::TestWithParam<Case> {};

TEST_P(HardCase, LosesNothing) {
  const Case c = GetParam();
  Scene scene;
  make_bed(scene, c);
  const double grains = scene.sum(scene.lammps().atom->nlocal), mass = scene.grain_mass(),
               level = top_of(scene);
  scene.command(
      fmt::format("fix wheel all wheel/rigid diameter 0.1 width 0.05 shoulder 0.005 mass 0.5 "
                  "inertia 6e-4 segments 48 axle -0.05 0 {:.9f}",
                  level + 0.052 + c.drop));
  scene.command(
      fmt::format("fix rig all wheel/rig wheel wheel load_force 12 speed 0.1 mode slip slip {} "
                  "settle_time 0.3 load_ramp_time {} "
                  "accelerate_time 0.1 ground_level {:.9f} damping 2",
                  c.slip, c.drop > 0.0 ? 0.001 : 0.1, level));
  scene.command("fix skin all mesh/body body wheel type 2");
  scene.command(fmt::format("fix tread all wall/gran/body {} mesh n_meshes 1 meshes skin", hertz));
  const RigidWheel& wheel =
      dynamic_cast<coupling::FixWheelRigid*>(scene.lammps().modify->find_fix_id("wheel"))->wheel();
  EnergyRise rise;
  MaxError kinetic;
  scene.at_end_of_step([&] {
    rise.add(energy_of_grains(scene) + wheel.energy_budget().contact_work);
    kinetic.add(scene.grain_kinetic_energy());
  });
  const double at_start = energy_of_grains(scene);
  scene.command(fmt::format("run {}", static_cast<int>(0.9 / c.step)));
  printf("XX %s rise %g kinetic max %g start %g end %g work %g mgl %g\n", c.name, rise.max(),
         kinetic.max(), at_start, energy_of_grains(scene), -wheel.energy_budget().contact_work,
         mass * 9.81 * level);
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

/// A column of sticky grains whose side is taken away falls and comes to rest: kinetic energy never
/// exceeds what gravity gives.
TEST(HardCases, CohesiveColumnCollapses) {
  Scene scene;
  const double step = 2e-5;
  scene.granular_box(Vector3(-0.6, -0.6, -0.01), Vector3(0.6, 0.6, 0.2), 0.003);
  scene.contact_properties(5e6, 0.3, 0.3, 0.5);
  scene.command(
      "fix stick all property/global cohesionEnergyDensity peratomtypepair 2 5e4 5e4 5e4 5e4");
  const std::string contact = "model hertz tangential history cohesion sjkr2";
  scene.commands(
      fmt::format("pair_style gran {0}\npair_coeff * *\ntimestep {1}\nfix weight all gravity 9.81 "
                  "vector 0 0 -1\n"
                  "fix floor all wall/gran {0} primitive type 1 zplane 0\nfix side all wall/gran "
                  "{0} primitive type 1 zcylinder 0.04 0 0",
                  contact, step));
  scene.commands(
      "fix pts all particletemplate/sphere 15485863 atom_type 1 density constant 2500 radius "
      "constant 0.004\n"
      "fix pdd all particledistribution/discrete 32452843 1 pts 1.0\n"
      "region fill cylinder z 0 0 0.04 0 0.19 units box\n"
      "fix ins all insert/pack seed 32452867 distributiontemplate pdd insert_every once "
      "overlapcheck yes all_in yes "
      "volumefraction_region 0.28 region fill\n"
      "fix move all nve/sphere\nfix calm all viscous 0.02\nthermo 100000\nrun 20000\nunfix "
      "calm\nunfix ins\nunfix side");
  const double grains = scene.sum(scene.lammps().atom->nlocal), mass = scene.grain_mass(),
               top = top_of(scene);
  double liveliest = 0.0;
  EnergyRise rise;
  scene.at_end_of_step([&] {
    rise.add(energy_of_grains(scene));
    liveliest = std::max(liveliest, scene.grain_kinetic_energy());
  });
  const double at_start = energy_of_grains(scene);
  scene.command("run 25000");
  printf("XX column rise %g kinetic max %g start %g end %g mgtop/2 %g\n", rise.max(), liveliest,
         at_start, energy_of_grains(scene), mass * 9.81 * top / 2);
  const double energy = scene.grain_kinetic_energy();
  EXPECT_EQ(scene.sum(scene.lammps().atom->nlocal), grains);
  EXPECT_LT(liveliest, mass * 9.81 * top / 2);
  EXPECT_LT(energy, 0.2 * liveliest);
}

}  // namespace
}  // namespace furrow::test::hard_cases_test
