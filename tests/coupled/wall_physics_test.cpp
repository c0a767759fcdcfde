// SPDX-License-Identifier: GPL-2.0-or-later
// The mesh wall of a deforming body against statics and conservation: weight, a rolling sphere, a
// periodic moving sheet whose triangles change rank, and the audit of nodal forces and moments in
// every step.

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "atom.h"
#include "tests/coupled/support/scene.h"
#include "tests/support/max_error.h"
#include "update.h"

namespace furrow::test::wall_physics_test {
namespace {

constexpr double gravity = 9.81, momentum_limit = 1e-10;

void expect_small_audit(Scene& scene, const std::string& body) {
  const coupling::MomentumAudit& audit = scene.system().audit(scene.body(body));
  EXPECT_LT(audit.force, momentum_limit);
  EXPECT_LT(audit.moment, momentum_limit);
  EXPECT_GT(audit.force_scale, 0.0);
}

constexpr const char* hertz = "model hertz tangential history";

/// 400 grains poured on a floor that first heaves in waves and then holds a bent shape. Check:
/// statics, floor force = m g.
TEST(WallPhysics, DeformingFloorCarriesTheWeightOfTheBed) {
  Scene scene;
  const double side = 0.08;
  scene.granular_box(Vector3(-side / 2, -side / 2, 0), Vector3(side / 2, side / 2, 0.2), 0.002,
                     "p p f");
  scene.contact_properties(5e6, 0.3, 0.3, 0.5);
  scene.grains_fall(hertz, 2e-5, gravity);
  // Heave that fades to a fixed wave; both edges of the periodic sheet move alike.
  const Surface flat = make_sheet(8, side, 0.02);
  const auto heave = [=](double time, Surface& surface) {
    const double k = 2.0 * pi / side, omega = 60.0, fade = std::exp(-10.0 * time);
    for (Eigen::Index n = 0; n < flat.x.cols(); ++n) {
      const double shape = std::sin(k * flat.x(0, n)) * std::cos(k * flat.x(1, n));
      surface.x(2, n) = 0.02 + 0.004 * shape * (1.0 + fade * std::sin(omega * time));
      surface.v(2, n) =
          0.004 * shape * fade * (omega * std::cos(omega * time) - 10.0 * std::sin(omega * time));
    }
  };
  scene.add_body("floor", std::make_unique<PrescribedBody>(flat, heave));
  scene.wall_of_body("floor", hertz, "walls");
  scene.pour(0.004, "block -0.04 0.04 -0.04 0.04 0.035 0.15", "particles_in_region 400", "no");
  scene.commands("fix calm all viscous 0.02\nthermo 100000");
  scene.command("run 60000");
  double sum = 0.0;
  int samples = 0;
  const Body& floor = scene.body("floor");
  scene.at_end_of_step([&] {
    sum += floor.surface().total_force()[2];
    ++samples;
  });
  scene.command("run 500");
  const double weight = scene.grain_mass() * gravity;
  EXPECT_NEAR(-sum / samples / weight, 1.0, 1e-4);
  expect_small_audit(scene, "floor");
}

/// A sphere that rolls without sliding over a flat sheet must not notice triangles: rolling on a
/// plane is the exact solution.
TEST(WallPhysics, SphereRollsOnAFlatMeshAsOnAPlane) {
  Scene scene;
  scene.granular_box(Vector3(-0.11, -0.11, 0), Vector3(0.11, 0.11, 0.2), 0.0015);
  scene.contact_properties(5e6, 0.3, 0.3, 0.5);
  scene.grains_fall(hertz, 1e-5, gravity);
  scene.add_body("sheet", std::make_unique<PrescribedBody>(make_sheet(20, 0.2, 0.1, true),
                                                           [](double, Surface&) {}));
  scene.wall_of_body("sheet", hertz, "walls");
  const double radius = 0.004, density = 2500.0,
               mass = density * 4.0 / 3.0 * pi * std::pow(radius, 3), speed = 0.3;
  const double e_star = 5e6 / (2.0 * (1.0 - 0.09));
  const double static_overlap =
      std::pow(mass * gravity / (4.0 / 3.0 * e_star * std::sqrt(radius)), 2.0 / 3.0);
  scene.command(
      fmt::format("create_atoms 1 single -0.07 -0.0531 {:.17g}", 0.1 + radius - static_overlap));
  scene.command("set group all density 2500 diameter 0.008");
  const Vector3 direction = Vector3(1.0, 0.77, 0.0).normalized();
  LAMMPS_NS::Atom& atom = *scene.lammps().atom;
  // LIGGGHTS's torque arm: rolling means zero slip there
  const double arm = radius - 0.5 * static_overlap;
  for (int i = 0; i < atom.nlocal; ++i)
    for (int k = 0; k < 3; ++k) {
      atom.v[i][k] = speed * direction[k];
      atom.omega[i][k] = speed / arm * Vector3::UnitZ().cross(direction)[k];
    }
  scene.command("fix move all nve/sphere");
  Range normal_force, rolling_speed;
  MaxError sideways;
  scene.at_end_of_step([&] {
    Vector3 force = Vector3::Zero(), velocity = Vector3::Zero();
    for (int i = 0; i < atom.nlocal; ++i) {
      force = Eigen::Map<const Vector3>(atom.f[i]);
      velocity = Eigen::Map<const Vector3>(atom.v[i]);
    }
    for (int k = 0; k < 3; ++k) {
      force[k] = scene.sum(force[k]);
      velocity[k] = scene.sum(velocity[k]);
    }
    normal_force.add(force[2] + mass * gravity);  // without the grain's weight
    rolling_speed.add(velocity.dot(direction));
    sideways.add(velocity.dot(Vector3::UnitZ().cross(direction)));
  });
  scene.command("run 40000");
  const double weight = mass * gravity;
  EXPECT_NEAR(normal_force.min() / weight, 1.0, 1e-3);
  EXPECT_LT((normal_force.max() - normal_force.min()) / weight, 1e-6);
  EXPECT_NEAR(rolling_speed.min() / speed, 1.0, 1e-6);
  EXPECT_NEAR(rolling_speed.max() / speed, 1.0, 1e-6);
  EXPECT_LT(sideways.max() / speed, 1e-6);
  expect_small_audit(scene, "sheet");
}

/// A sheet that runs through a periodic box, four times its length, under a sphere held at constant
/// overlap: the force stays Hertz's over every edge and over the seam, and triangles pass from rank
/// to rank. Friction takes mu N times the distance.
TEST(WallPhysics, PeriodicMeshMovesUnderASphere) {
  Scene scene;
  const double side = 0.1, radius = 0.004, overlap = 4e-6, speed = 2.0;
  scene.granular_box(Vector3(-side / 2, -side / 2, 0), Vector3(side / 2, side / 2, 0.2), 0.0015,
                     "p p f");
  const double friction = 0.4;
  scene.contact_properties(5e6, 0.3, 0.3, friction);
  scene.commands(fmt::format("pair_style gran {}\npair_coeff * *\ntimestep 1e-5", hertz));
  const Surface start = make_sheet(10, side, 0.1);
  scene.add_body("belt",
                 std::make_unique<PrescribedBody>(start, [=](double time, Surface& surface) {
                   surface.x.row(0) = start.x.row(0).array() + speed * time;
                   surface.x.row(1) = start.x.row(1).array() + 0.37 * speed * time;
                   surface.v.row(0).setConstant(speed);
                   surface.v.row(1).setConstant(0.37 * speed);
                 }));
  scene.wall_of_body("belt", hertz, "walls");
  scene.command(fmt::format("create_atoms 1 single 0.0012 0.0007 {:.17g}", 0.1 + radius - overlap));
  scene.command("set group all density 2500 diameter 0.008");
  const double expected =
      4.0 / 3.0 * 5e6 / (2.0 * (1.0 - 0.09)) * std::sqrt(radius) * std::pow(overlap, 1.5);
  Range normal_force;
  scene.at_end_of_step([&] {
    LAMMPS_NS::Atom& atom = *scene.lammps().atom;
    double normal = 0.0;
    for (int i = 0; i < atom.nlocal; ++i) normal = atom.f[i][2];
    normal_force.add(scene.sum(normal));
  });
  scene.command("run 20000");
  EXPECT_NEAR(normal_force.min() / expected, 1.0, 1e-3);
  EXPECT_NEAR(normal_force.max() / expected, 1.0, 1e-3);
  expect_small_audit(scene, "belt");
  const double distance = 20000 * 1e-5 * speed * std::hypot(1.0, 0.37);
  const coupling::ContactWork& work = scene.system().contact_work(scene.body("belt"));
  EXPECT_NEAR(work.friction / (friction * expected * distance), 1.0, 1e-3);
  EXPECT_EQ(work.press, 0.0);
  EXPECT_EQ(work.push, 0.0);
  EXPECT_NEAR(work.contact / work.friction, 0.0, 1e-12);
}

/// A rising and sliding sheet strikes a grain without weight: the work on the grain is its energy
/// of flight and spin, to rounding, and the contact takes the rest.
TEST(WallPhysics, WorkOnAGrainIsItsChangeOfEnergy) {
  Scene scene;
  scene.granular_box(Vector3(-0.05, -0.05, 0), Vector3(0.05, 0.05, 0.2), 0.0015);
  scene.contact_properties(5e6, 0.3, 0.5, 0.3);
  scene.commands(fmt::format("pair_style gran {}\npair_coeff * *\ntimestep 1e-5", hertz));
  const Surface start = make_sheet(10, 0.08, 0.05);
  const Vector3 speed(1.0, 0.4, 0.5);
  scene.add_body("bat", std::make_unique<PrescribedBody>(start, [=](double time, Surface& surface) {
                   surface.x = start.x.colwise() + speed * time;
                   surface.v.colwise() = speed;
                 }));
  scene.wall_of_body("bat", hertz, "walls");
  scene.command("create_atoms 1 single 0.011 0.007 0.055");
  scene.command("set group all density 2500 diameter 0.008");
  scene.command("fix move all nve/sphere");
  double given = 0.0;  // [J] by the sheet
  scene.at_end_of_step([&] {
    given -= scene.body("bat").surface().total_force().dot(speed) * scene.lammps().update->dt;
  });
  scene.command("run 1000");
  const coupling::ContactWork& work = scene.system().contact_work(scene.body("bat"));
  const double energy = scene.grain_kinetic_energy();
  const LAMMPS_NS::Atom& atom = *scene.lammps().atom;
  double lift = 0.0;  // [J]
  for (int i = 0; i < atom.nlocal; ++i) lift += 0.5 * atom.rmass[i] * atom.v[i][2] * atom.v[i][2];
  lift = scene.sum(lift);
  EXPECT_GT(lift, 0.0);
  EXPECT_NEAR(work.press / lift, 1.0, 1e-9);
  EXPECT_NEAR(work.push / (energy - lift), 1.0, 1e-9);
  EXPECT_NEAR((work.press + work.push + work.friction + work.contact) / given, 1.0, 1e-9);
  EXPECT_GT(work.friction, 0.05 * given);
  EXPECT_GT(work.contact, 0.05 * given);
}

}  // namespace
}  // namespace furrow::test::wall_physics_test
