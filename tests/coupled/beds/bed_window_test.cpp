// SPDX-License-Identifier: GPL-2.0-or-later
// A bed that is renewed while nothing touches it must not notice: the copies, their contact
// histories and the seams are those of the settled bed. The body flies over it, so slab after slab
// is taken out and put in again.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "atom.h"
#include "modify.h"
#include "tests/coupled/support/sand.h"
#include "tests/coupled/support/snow.h"
#include "tests/support/max_error.h"

namespace furrow::test::bed_window_test {
namespace {

constexpr double diameter = SandBed::diameter, length = SandBed::length, step = SandBed::step;

double mean_height(Scene& scene) {
  const LAMMPS_NS::Atom& atom = *scene.lammps().atom;
  double sum = 0.0;
  for (int i = 0; i < atom.nlocal; ++i) sum += atom.x[i][2];
  return scene.sum(sum) / scene.sum(atom.nlocal);
}

/// Sintered snow: a layer of clusters that overlap by a hundredth of their diameter, and bear their
/// weight by bonds.
void make_sintered_bed(Scene& scene) {
  scene.granular_box(Vector3(-length / 2, -0.04, -0.01), Vector3(length / 2, 0.04, 0.2), 0.003,
                     "p f f");
  SnowBondParameters soft;
  soft.E = 2e6;  // longer steps
  snow_contacts(scene, soft);
  scene.commands(fmt::format(
      "timestep 1.5e-5\nfix weight all gravity 9.81 vector 0 0 -1\n"
      "fix floor all wall/gran {} primitive type 2 zplane 0\nlattice sc 0.008\n"
      "region layer block -0.12 0.1199 -0.028 0.028 0.004 0.036 units box\n"
      "create_atoms 1 region layer\ndisplace_atoms all move 0.001 0 -0.003961 units box\n"
      "set group all diameter 0.00808 density 340\nfix move all nve/sphere\n"
      "fix energy all snow/energy\nthermo 100000",
      snow_model));
  sinter(scene);
  scene.commands("fix calm all viscous 0.003\nrun 3000\nunfix calm");
}

double bonds_of(Scene& scene) {
  return scene.lammps().modify->find_fix_id("energy") ? snow_energy(scene, 5) : 0.0;
}

struct Bed {
  void (*make)(Scene&);
  const char* contact;
  double speed;  // of the body [m/s]
  long steps;    // two rounds and a half
};

class BedWindow : public testing::TestWithParam<Bed> {};

TEST_P(BedWindow, RenewedSlabsKeepGrainsAtRest) {
  Scene scene;
  const auto [make, contact, speed, steps] = GetParam();
  make(scene);
  const double grains = scene.sum(scene.lammps().atom->nlocal), mass = scene.grain_mass(),
               height = mean_height(scene), bonds = bonds_of(scene);
  Surface sheet = make_sheet(2, 0.04, 0.18);
  const Matrix3X start = sheet.x;
  scene.add_body("kite", std::make_unique<PrescribedBody>(
                             sheet, [start, v = speed](double time, Surface& surface) {
                               surface.x = start;
                               surface.x.row(0).array() += v * time;
                               surface.v.setZero();
                               surface.v.row(0).setConstant(v);
                             }));
  scene.wall_of_body("kite", contact, "wall");
  scene.command("fix renew all bed/window body kite slabs 8 behind 0.06");
  MaxError kinetic_energy;
  scene.at_end_of_step([&] { kinetic_energy.add(scene.grain_kinetic_energy()); });
  scene.command(fmt::format("run {}", steps));

  const double renewed = scene.lammps().modify->find_fix_id("renew")->compute_vector(0);
  // energy of the bed falling by a thousandth of a grain
  const double fall = mass * 9.81 * 0.001 * diameter;
  EXPECT_EQ(renewed, 20);
  EXPECT_EQ(scene.sum(scene.lammps().atom->nlocal), grains);
  EXPECT_NEAR(scene.grain_mass() / mass, 1.0, 1e-12);
  EXPECT_LT(kinetic_energy.max(), fall);
  EXPECT_NEAR(mean_height(scene), height, 1e-3 * diameter);
  EXPECT_EQ(bonds_of(scene), bonds);
}

INSTANTIATE_TEST_SUITE_P(Beds, BedWindow,
                         testing::Values(Bed{[](Scene& scene) { make_sand_bed(scene); }, hertz, 1.0,
                                             15000},
                                         Bed{make_sintered_bed, snow_model, 5.0, 8000}),
                         [](const auto& entry) { return entry.index == 0 ? "sand" : "snow"; });

}  // namespace
}  // namespace furrow::test::bed_window_test
