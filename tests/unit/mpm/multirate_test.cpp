// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/multirate.h"

#include <cmath>

#include <gtest/gtest.h>

#include "terrain_scene.h"
#include "tests/support/checkpoints.h"

namespace furrow::multirate_test {
namespace {

using testing_terrain::box;
using testing_terrain::elastic;
using testing_terrain::even;
using testing_terrain::material_of;
using testing_terrain::set_boundary;

/// A mass whose one node a spring holds, from rest at 1 m, w = 1/s. @return position after a whole
/// number of periods; cos(w t) = 1 in closed form
double after_periods(int periods, int steps_of_mass, int steps_of_spring) {
  const double period = 2.0 * M_PI;
  const double interval = period / steps_of_mass;
  const double dt = interval / steps_of_spring;
  Surface node;
  node.resize(1);
  node.x(2, 0) = 1.0;
  double x = 1.0;
  double v = 0.5 * interval;  // half a step before the start
  node.v(2, 0) = v;
  Multirate multirate;
  multirate.begin(node, dt, 1.001 * interval);
  for (int n = 0; n < periods * steps_of_mass * steps_of_spring; ++n) {
    node.f(2, 0) = -node.x(2, 0);
    if (!multirate.add(node, dt)) continue;
    v += multirate.elapsed() * multirate.mean_force()(2, 0);
    x += multirate.elapsed() * v;
    node.x(2, 0) = x;
    node.v(2, 0) = v;
    multirate.begin(node, dt, 1.001 * interval);
  }
  return x;
}

/// A mass under a constant force with steps of two lengths: momentum is F t, and the mass moves by
/// its velocity for as long as the grains do.
TEST(Multirate, TerrainTimeFollowsAChangingGrainStep) {
  Surface node;
  node.resize(1);
  node.f(2, 0) = 3.0;
  Multirate multirate;
  multirate.begin(node, 1.0, 10.5);
  double grains = 0.0, terrain = 0.0, momentum = 0.0;
  const double steps[] = {1.0, 0.7, 0.7, 0.45, 0.9};
  for (int n = 0; n < 500; ++n) {
    const double dt = steps[n / 7 % 5];
    grains += dt;
    if (!multirate.add(node, dt)) continue;
    EXPECT_LE(multirate.elapsed(), 10.5);
    terrain += multirate.elapsed();
    momentum += multirate.elapsed() * multirate.mean_force()(2, 0);
    EXPECT_NEAR(terrain, grains, 1e-12 * grains);
    EXPECT_NEAR(momentum, 3.0 * grains, 1e-12 * momentum);
    multirate.begin(node, dt, 10.5);
  }
  EXPECT_GT(terrain, 300.0);
}

/// Leapfrog's position after n steps of T is cos(n theta) with sin(theta/2) = w T/2, for any step
/// of the grains: the forces of an interval lie symmetric about the mass. Rounding grows with the
/// number of steps.
TEST(Multirate, SpringFollowsLeapfrogToRounding) {
  for (const int steps : {1, 2, 5})
    for (const int periods : {1, 4, 100})
      for (const int per_period : {20, 40}) {
        const double angle = 2.0 * std::asin(M_PI / per_period) * per_period * periods;
        EXPECT_NEAR(after_periods(periods, per_period, steps), std::cos(angle), 1e-9)
            << steps << ' ' << periods << ' ' << per_period;
      }
}

/// An elastic block on a rough base under grains that are springs, one on each node of its sheet,
/// pressed by 2 mm at the start.
struct Block {
  static constexpr double stiffness = 1e3, free_height = 0.098;  // [N/m], [m]
  /// @param steps  of the springs for one of the ground; 1: not multirate
  explicit Block(int steps) : ground(parameters(steps), Communicator()) {}
  static TerrainParameters parameters(int steps) {
    TerrainParameters p =
        box(material_of(elastic(1e6, 0.2, 1500)), {0, 0, 0}, {0.2, 0.2, 0.1}, 0.025);
    p.z = even(0, 0.15, 0.025);
    set_boundary(p, {"smooth", "smooth", "smooth", "smooth", "rough", "free"});
    p.surface_mesh = true;
    p.scheme = {false, 0.0};  // damps the waves of the release
    p.surface_mesh_every = 2;
    p.multirate = steps > 1;
    p.cfl = 0.4 * (steps + 0.2) / 8.2;
    return p;
  }
  void run(int steps) {
    Surface& sheet = ground.surface();
    for (int n = 0; n < steps; ++n) {
      sheet.f.setZero();
      sheet.f.row(2) = -stiffness * (sheet.x.row(2).array() - free_height);
      impulse += dt * sheet.total_force().z();
      ground.advance(dt);
    }
  }
  /// An eighth of the ground's with the default cfl.
  static double step_of_springs() {
    return ContinuumTerrain(parameters(8), Communicator()).stable_time_step() / 8.2;
  }
  double height() { return ground.surface().x.row(2).mean(); }
  double energy_of_springs() {
    return 0.5 * stiffness * (ground.surface().x.row(2).array() - free_height).square().sum();
  }
  /// Energy of springs and ground, with what the discretisation took.
  double energy() {
    const EnergyBudget budget = ground.energy_budget();
    return energy_of_springs() + budget.kinetic_energy + budget.stored_energy +
           budget.numerical_loss;
  }
  ContinuumTerrain ground;
  double dt = Block::step_of_springs();  // [s]
  double impulse = 0.0;                  // of the springs on the ground [N s]
};

/// The sheet swings as that of a block that takes every step; energy is kept, the better the
/// shorter the interval is, and momentum to rounding.
TEST(Multirate, MultipleTimeStepsKeepResponseMomentumAndEnergy) {
  Block every(1), fourth(4), eighth(8);
  constexpr int samples = 60;
  double largest = 0.0, difference[2] = {}, energy[3] = {};
  for (int n = 0; n < samples; ++n) {
    for (Block* block : {&every, &fourth, &eighth}) block->run(16);
    largest = std::max(largest, std::abs(every.height() - 0.1));
    difference[0] = std::max(difference[0], std::abs(fourth.height() - every.height()));
    difference[1] = std::max(difference[1], std::abs(eighth.height() - every.height()));
    energy[0] += every.energy() / samples;
    energy[1] += fourth.energy() / samples;
    energy[2] += eighth.energy() / samples;
  }
  EXPECT_GT(largest, 5e-4);
  // waves of the release have periods of some intervals
  for (const double each : difference) EXPECT_LT(each, 0.08 * largest);
  EXPECT_NEAR(energy[1], energy[0], 0.015 * energy[0]);
  EXPECT_NEAR(energy[2], energy[0], 0.03 * energy[0]);
  for (const Block* block : {&fourth, &eighth})
    EXPECT_NEAR(block->ground.energy_budget().momentum.z(),
                block->ground.boundary_impulse(Face::z_lower).z() + block->impulse,
                1e-9 * std::abs(block->impulse));
}

TEST(Multirate, RestartWithinAnIntervalContinuesBitwise) {
  Block whole(8), first(8), continued(8);
  whole.run(42);
  first.run(21);
  test::restore(continued.ground, test::state_of(first.ground));
  continued.run(21);
  EXPECT_EQ(test::state_of(continued.ground), test::state_of(whole.ground));
  EXPECT_EQ(continued.ground.surface().x, whole.ground.surface().x);
}

}  // namespace
}  // namespace furrow::multirate_test
