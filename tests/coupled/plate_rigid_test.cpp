// SPDX-License-Identifier: GPL-2.0-or-later
// A plate pushed onto a grain that is held: sinkage is speed times time, force and pressure are
// Hertz's (1882), F = 4/3 E* sqrt(R) delta^(3/2), E* = E/(2 (1 - nu^2)), and the outputs of the fix
// in LIGGGHTS are these.

#include <cmath>

#include <gtest/gtest.h>

#include "fix.h"
#include "modify.h"
#include "tests/coupled/support/scene.h"

namespace furrow::test::plate_rigid_test {
namespace {

TEST(PlateRigid, SinkageForceAndPressureOnAFixedGrain) {
  constexpr double young = 5e6, poisson = 0.3, radius = 0.004, gap = 0.0005, speed = 0.01,
                   duration = 0.1, size = 0.06;
  Scene scene;
  scene.granular_box(Vector3(-0.1, -0.1, 0.0), Vector3(0.1, 0.1, 0.2), 0.001);
  scene.contact_properties(young, poisson, 1.0, 0.0);  // elastic: no damping adds to Hertz's force
  scene.commands(
      "create_atoms 1 single 0.011 0.007 0.05\n"
      "set group all diameter 0.008 density 2500\n"
      "pair_style gran model hertz tangential history\npair_coeff * *\ntimestep 1e-4\n"
      "fix plate all plate/rigid size 0.06 thickness 0.01 elements 12 centre 0 0 0.0545 speed 0.01 "
      "accelerate_time 0 "
      "ground_level 0.0545\n"
      "fix skin all mesh/body body plate type 1\n"
      "fix face all wall/gran/body model hertz tangential history mesh n_meshes 1 meshes skin\n"
      "run 1000");
  LAMMPS_NS::Fix& plate = *scene.lammps().modify->find_fix_id("plate");
  const double overlap = speed * duration - gap;
  const double force = 4.0 / 3.0 * young / (2.0 * (1.0 - poisson * poisson)) * std::sqrt(radius) *
                       std::pow(overlap, 1.5);
  EXPECT_NEAR(plate.compute_vector(0), speed * duration, 1e-12);
  EXPECT_NEAR(plate.compute_vector(1), force, 1e-6 * force);
  EXPECT_NEAR(plate.compute_vector(2), force / (M_PI / 4.0 * size * size),
              1e-6 * force / (size * size));
}

// The drive holds its load on the spring of a held grain: Hertz's overlap of that force.
TEST(PlateRigid, LoadIsHeldOnAFixedGrain) {
  constexpr double young = 5e6, poisson = 0.3, radius = 0.004, load = 2.0;
  Scene scene;
  scene.granular_box(Vector3(-0.1, -0.1, 0.0), Vector3(0.1, 0.1, 0.2), 0.001);
  scene.contact_properties(young, poisson, 1.0, 0.0);
  scene.commands(
      "create_atoms 1 single 0.011 0.007 0.05\n"
      "set group all diameter 0.008 density 2500\n"
      "pair_style gran model hertz tangential history\npair_coeff * *\ntimestep 1e-4\n"
      "fix plate all plate/rigid size 0.06 thickness 0.01 elements 12 centre 0 0 0.0545 speed 0.01 "
      "load 2 accelerate_time 0 ground_level 0.054\n"
      "fix skin all mesh/body body plate type 1\n"
      "fix face all wall/gran/body model hertz tangential history mesh n_meshes 1 meshes skin\n"
      "run 8000");
  LAMMPS_NS::Fix& plate = *scene.lammps().modify->find_fix_id("plate");
  const double overlap = std::pow(
      load / (4.0 / 3.0 * young / (2.0 * (1.0 - poisson * poisson)) * std::sqrt(radius)), 2.0 / 3);
  EXPECT_NEAR(plate.compute_vector(1), load, 1e-6 * load);
  EXPECT_NEAR(plate.compute_vector(0), overlap, 1e-6 * overlap);
}

}  // namespace
}  // namespace furrow::test::plate_rigid_test
