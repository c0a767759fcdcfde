// SPDX-License-Identifier: GPL-2.0-or-later
// Hard cases of sintered snow. In each no cluster is lost, every number is finite, and the energy
// that a plate, a wheel and gravity give is found again: in motion, in the springs, in crushing, in
// dampers, and in bonds that broke. The error is that of the time step.

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "atom.h"
#include "coupling/wheels/fix_wheel_rigid.h"
#include "modify.h"
#include "tests/coupled/support/scene.h"
#include "tests/coupled/support/snow.h"

namespace furrow::test::snow_hard_cases_test {
namespace {

constexpr double gravity = 9.81, density = 340.0, diameter = 0.02;  // [m/s^2], [kg/m^3], [m]
constexpr double start_height = 0.13, layer_height = 0.06;          // [m] of the plate, of layers
constexpr double energy_error = 0.03;                               // of the largest energy

/// Energy of clusters and their contacts [J]; only external forces change it.
double energy_of_snow(Scene& scene) {
  const LAMMPS_NS::Atom& atom = *scene.lammps().atom;
  double weight = 0.0, contacts = 0.0;
  for (int i = 0; i < atom.nlocal; ++i) weight += gravity * atom.rmass[i] * atom.x[i][2];
  for (const int entry : {1, 2, 3, 4}) contacts += snow_energy(scene, entry);
  return scene.grain_kinetic_energy() + scene.sum(weight) + contacts;
}

void expect_sound(Scene& scene, double clusters, double energy, double work, double scale) {
  const double now = energy_of_snow(scene);
  EXPECT_EQ(scene.sum(scene.lammps().atom->nlocal), clusters);
  EXPECT_GT(scale, 0.0);
  EXPECT_NEAR((now - energy - work) / scale, 0.0, energy_error);
  EXPECT_NEAR(snow_energy(scene, 5), snow_energy(scene, 6) - snow_energy(scene, 7), 1e-9);
}

struct Stroke {
  double speed, duration;  // [m/s] downwards, [s]
};

struct Case {
  const char* name;
  std::vector<Stroke> strokes = {};  // of a plate as wide as the box; none: there is no plate
  SnowBondParameters lower = {}, upper = {};
  double upper_density = density;
  double falls = 0.0;  // [m/s]
  bool walls = true;   // around it
};

void add_walls(Scene& scene, double half_length, double half_width) {
  for (const char side : {'x', 'y'})
    for (const int sign : {-1, 1})
      scene.command(fmt::format("fix {0}{1} all wall/gran {2} primitive type 2 {0}plane {3}", side,
                                sign > 0 ? 2 : 1, snow_model,
                                sign * (side == 'x' ? half_length : half_width)));
}

/// Clusters in a block of fcc lattice, 0.12 m wide and 0.115 m high; those above layer_height are
/// of type 2, and the walls as well.
void make_block(Scene& scene, const Case& c) {
  scene.granular_box({-0.12, -0.12, -0.05}, {0.12, 0.12, 0.25}, 0.006);
  snow_contacts(scene, c.lower, c.upper);
  scene.commands(
      fmt::format("timestep 1e-5\nfix weight all gravity {} vector 0 0 -1\n"
                  "fix floor all wall/gran {} primitive type 2 zplane 0",
                  gravity, snow_model));
  if (c.walls) add_walls(scene, 0.062, 0.062);
  scene.commands(
      fmt::format("lattice fcc 0.0278\nregion block block -0.06 0.06 -0.055 0.055 0.001 0.115 "
                  "units box\ncreate_atoms 1 region block\n"
                  "displace_atoms all move 0.0013 0.0007 0.0095 units box\n"
                  "region upper block INF INF INF INF {} INF units box\nset region upper type 2\n"
                  "set group all diameter {} density {}\nset region upper density {}\n"
                  "fix move all nve/sphere\nfix energy all snow/energy\nthermo 100000",
                  layer_height, diameter, density, c.upper_density));
  sinter(scene);
  scene.command(fmt::format("velocity all set 0 0 {}", -c.falls));
}

/// A level plate that follows the strokes.
void add_plate(Scene& scene, const std::vector<Stroke>& strokes) {
  const auto motion = [strokes](double time, Surface& surface) {
    double depth = 0.0, speed = 0.0;
    for (const Stroke& stroke : strokes) {
      depth += stroke.speed * std::clamp(time, 0.0, stroke.duration);
      if (time > 0.0) speed = stroke.speed;
      time -= stroke.duration;
    }
    surface.x.row(2).setConstant(start_height - depth);
    surface.v.setZero();
    surface.v.row(2).setConstant(-speed);
  };
  scene.add_body("plate",
                 std::make_unique<PrescribedBody>(make_sheet(6, 0.2, start_height), motion));
  scene.wall_of_body("plate", snow_model, "face");
}

class SnowHardCase : public testing::TestWithParam<Case> {};

TEST_P(SnowHardCase, EnergyBalanceCloses) {
  const Case& c = GetParam();
  Scene scene;
  make_block(scene, c);
  double duration = 0.05, work = 0.0, force = 0.0;
  if (!c.strokes.empty()) {
    add_plate(scene, c.strokes);
    duration = 0.0;
    for (const Stroke& stroke : c.strokes) duration += stroke.duration;
    const Surface& plate = scene.body("plate").surface();
    scene.at_end_of_step([&] {
      const double now = plate.total_force().z();
      work -= 0.5 * (force + now) * plate.v(2, 0) * 1e-5;  // on the snow
      force = now;
    });
  }
  const double clusters = scene.sum(scene.lammps().atom->nlocal), energy = energy_of_snow(scene),
               motion = scene.grain_kinetic_energy();
  scene.command(fmt::format("run {}", std::lround(duration / 1e-5)));
  expect_sound(scene, clusters, energy, work, std::max(std::abs(work), motion));
}

SnowBondParameters cohesion(double factor) {
  SnowBondParameters law;
  law.chi *= factor;
  law.zeta *= factor;
  return law;
}

SnowBondParameters strength(double factor) {
  SnowBondParameters law;
  law.Y0 *= factor;
  law.Y1 *= factor;
  return law;
}

const std::vector<Stroke> half = {{1.2, 0.06}};  // to 0.058 m

INSTANTIATE_TEST_SUITE_P(
    Block, SnowHardCase,
    testing::Values(Case{"half", half}, Case{"ninety_per_cent", {{1.2, 0.0987}}},
                    Case{"ten_times_the_rate", {{12.0, 0.006}}},
                    Case{"second_pass", {{1.2, 0.04}, {-1.2, 0.02}, {1.2, 0.04}}},
                    Case{"no_cohesion", half, cohesion(0.0), cohesion(0.0)},
                    Case{"ten_times_the_cohesion", half, cohesion(10.0), cohesion(10.0)},
                    Case{"dense_over_light", half, {}, strength(10.0), 580.0},
                    Case{"crust", half, {}, strength(300.0)},
                    Case{"lump", {}, {}, {}, density, 5.0, false}),
    [](const auto& entry) { return entry.param.name; });

/// A wheel of 0.1 m digs itself in, at nine tenths of slip.
TEST(SnowHardCases, SpinningWheelHasAClosedEnergyBalance) {
  Scene scene;
  scene.granular_box({-0.12, -0.07, -0.01}, {0.12, 0.07, 0.25}, 0.003);
  SnowBondParameters soft;
  soft.E = 2e6;  // longer steps
  snow_contacts(scene, soft);
  constexpr double step = 2e-5, level = 0.045;
  scene.commands(
      fmt::format("timestep {}\nfix weight all gravity {} vector 0 0 -1\n"
                  "fix floor all wall/gran {} primitive type 2 zplane 0\nlattice fcc 0.0168\n"
                  "region bed block -0.1 0.1 -0.045 0.045 0.005 0.045 units box\n"
                  "create_atoms 1 region bed\ndisplace_atoms all move 0 0 -0.003 units box\n"
                  "set group all diameter 0.012 density {}\nfix move all nve/sphere\n"
                  "fix energy all snow/energy\nthermo 100000",
                  step, gravity, snow_model, density));
  add_walls(scene, 0.106, 0.052);
  sinter(scene);
  scene.commands(
      fmt::format("fix wheel all wheel/rigid diameter 0.1 width 0.05 shoulder 0.005 mass 2 inertia "
                  "2.5e-3 segments 48 axle -0.05 0 {0}\n"
                  "fix rig all wheel/rig wheel wheel load_force 25 speed 0.1 mode slip slip 0.9 "
                  "settle_time 0.08 load_ramp_time 0.04 accelerate_time 0.03 ground_level {1} "
                  "damping 20",
                  level + 0.055, level));
  scene.wall_of_body("wheel", snow_model, "tread");
  const RigidWheel& wheel =
      dynamic_cast<coupling::FixWheelRigid*>(scene.lammps().modify->find_fix_id("wheel"))->wheel();
  const double clusters = scene.sum(scene.lammps().atom->nlocal), energy = energy_of_snow(scene);
  scene.command("run 8000");
  const EnergyBudget budget = wheel.energy_budget();
  EXPECT_LT(wheel.centre().z(), level + 0.05);
  EXPECT_GT(snow_energy(scene, 7), 50.0);
  expect_sound(scene, clusters, energy, -budget.contact_work, std::abs(budget.contact_work));
}

}  // namespace
}  // namespace furrow::test::snow_hard_cases_test
