// SPDX-License-Identifier: GPL-2.0-or-later
// Ground with a sheet that moves along: what is dropped behind comes back ahead, undeformed and a
// length further on, and nothing of the sheet is lost or torn.
#include <random>

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "terrain_scene.h"
#include "tests/support/checkpoints.h"
#include "tests/support/error_of.h"

namespace furrow::moving_sheet_test {
namespace {

using ::testing::HasSubstr;
using testing_terrain::elastic;
using testing_terrain::for_particles;
using testing_terrain::ground_with_trough;
using testing_terrain::sums_of;

constexpr double length = 0.8, cell = 0.05, slab = 0.2, step = 1e-4;  // [m, m, m, s]
constexpr std::size_t slabs = 4;

/// 16 cells along x in four slabs, with a trough.
TerrainParameters moving_ground() {
  TerrainParameters ground =
      ground_with_trough(elastic(1e7, 0.25, 1500.0), {length, 0.6, 0.3}, 0.45, {0.3, 0.1}, cell);
  ground.surface_mesh_every = 2;
  ground.window = true;
  ground.slabs = slabs;
  return ground;
}

/// Follows something that has gone on by so many slabs and a little.
void move_on(ContinuumTerrain& ground, int to) {
  ground.follow(0.5 * length + (to + 0.01) * slab);
  for (int n = 0; n < 40 && ground.dropped_slabs() < static_cast<std::size_t>(to); ++n)
    ground.advance(step);
  ASSERT_EQ(ground.dropped_slabs(), static_cast<std::size_t>(to));
}

/// Grains that press here and there.
void shake(ContinuumTerrain& ground, int steps, double force) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> press(-force, force);
  Matrix3X& f = ground.surface().f;
  for (int n = 0; n < steps; ++n) {
    for (Eigen::Index i = 0; i < f.size(); ++i) f(i) = press(random);
    ground.advance(step);
  }
  f.setZero();
}

/// Lengths by which a patch is further on than at the start.
double rounds_of(std::size_t patch, std::size_t dropped) {
  return static_cast<double>((dropped + slabs - 1 - patch) / slabs);
}

TEST(MovingSheet, UndisturbedPatchesReappearOneLengthAhead) {
  ContinuumTerrain ground(moving_ground(), Communicator());
  const Matrix3X start = ground.surface().x;
  const double particles = ground.particle_count();
  const Eigen::Index nodes = start.cols() / static_cast<Eigen::Index>(slabs);
  for (int moved = 1; moved <= 9; ++moved) {
    move_on(ground, moved);
    Matrix3X expected = start;
    for (std::size_t patch = 0; patch < slabs; ++patch)
      expected.row(0).segment(static_cast<Eigen::Index>(patch) * nodes, nodes).array() +=
          length * rounds_of(patch, static_cast<std::size_t>(moved));
    EXPECT_LT((ground.surface().x - expected).cwiseAbs().maxCoeff(), 1e-12) << moved;
    EXPECT_EQ(ground.particle_count(), particles);
    EXPECT_NEAR(ground.travelled(), moved * slab, 1e-12);
  }
}

/// Slabs meet in one place where both are there, however the ground is deformed.
TEST(MovingSheet, PatchesHaveNoGap) {
  ContinuumTerrain ground(moving_ground(), Communicator());
  const Matrix3X start = ground.surface().x;
  move_on(ground, 1);
  shake(ground, 60, 200.0);
  const Matrix3X& x = ground.surface().x;
  const double newest = start.row(0).maxCoeff() + slab, oldest = start.row(0).minCoeff() + slab;
  double deformed = 0.0;
  int pairs = 0;
  const auto now = [&](Eigen::Index n) {  // of an undeformed sheet
    const Eigen::Index nodes = start.cols() / static_cast<Eigen::Index>(slabs);
    const auto patch = static_cast<std::size_t>(n / nodes);
    Vector3 place = start.col(n);
    place.x() += length * rounds_of(patch, 1);
    return place;
  };
  for (Eigen::Index a = 0; a < x.cols(); ++a)
    for (Eigen::Index b = a + 1; b < x.cols(); ++b) {
      if ((now(a) - now(b)).norm() > 1e-9) continue;
      ++pairs;
      EXPECT_EQ(x.col(a), x.col(b));
      EXPECT_GT(now(a).x(), oldest + 0.5 * slab);
      EXPECT_LT(now(a).x(), newest - 0.5 * slab);
      deformed = std::max(deformed, (x.col(a) - now(a)).norm());
    }
  EXPECT_GT(pairs, 30);
  EXPECT_GT(deformed, 1e-4);
}

/// Forces where two slabs meet are the ground's gain, in momentum and about any point.
TEST(MovingSheet, ForcesAndMomentsAreTransferredToTheGround) {
  TerrainParameters parameters = moving_ground();
  parameters.remap_interval = 1;
  ContinuumTerrain ground(parameters, Communicator());
  move_on(ground, 1);
  Surface& sheet = ground.surface();
  sheet.clear_forces();
  std::mt19937 random(11);
  std::uniform_real_distribution<double> press(-50.0, 50.0);
  int pressed = 0;
  for (Eigen::Index n = 0; n < sheet.x.cols(); ++n) {
    if (std::abs(sheet.x(0, n) - 3.0 * slab) > 1e-9 || std::abs(sheet.x(1, n)) > 0.11) continue;
    for (int k = 0; k < 3; ++k) sheet.f(k, n) = press(random);
    ++pressed;
  }
  EXPECT_GT(pressed, 6);
  const Vector3 force = sheet.total_force(), moment = sheet.total_moment(Vector3::Zero());
  ground.advance(step);
  const auto after = sums_of(ground);
  EXPECT_LT((after.momentum - step * force).norm(), 1e-9 * step * force.norm());
  EXPECT_LT((after.angular - step * moment).norm(), 1e-9 * step * moment.norm());
}

/// A block that flies at v and spins at w: the work of forces on the nodes of its sheet is their
/// power times dt, but for the motion of the nodes during the step, dt^2 f.(w x v). In a remap
/// interval of 16 steps the weights are taken up to 7.5 steps away from the particle.
TEST(MovingSheet, PowerOfNodalForcesIsTheirWorkOnTheGround) {
  TerrainParameters parameters =
      testing_terrain::box(testing_terrain::material_of(elastic(1e6, 0.25, 1000.0)),
                           {0.0, 0.0, 0.0}, {0.6, 0.6, 0.3}, cell);
  parameters.surface_mesh = true;
  ContinuumTerrain ground(parameters, Communicator());
  const Vector3 v(0.2, 0.0, 0.0), w(0.0, 0.0, 2.0);
  testing_terrain::set_motion(ground, v, testing_terrain::spin(w), {0.3, 0.3, 0.15});
  Surface& sheet = ground.surface();
  for (int n = 0; n < 8; ++n) {
    sheet.f.setZero();
    sheet.f.row(1).setConstant(1e-3);
    const double before = ground.energy_budget().contact_work;
    ground.advance(step);
    const double work = ground.energy_budget().contact_work - before,
                 power = sheet.f.cwiseProduct(sheet.v).sum(),
                 of_motion = step * step * sheet.total_force().dot(w.cross(v));
    EXPECT_NEAR(work, step * power, 2.0 * std::abs(of_motion)) << n;
  }
}

/// A wheel that drives pushes ground back, over the edge of the slab that is dropped.
TEST(MovingSheet, ParticlesPushedBackAreKept) {
  ContinuumTerrain ground(moving_ground(), Communicator());
  const double particles = ground.particle_count(), spacing = 0.5 * cell;
  double pushed = 0.0;
  for_particles(ground, [&](Particles& p, std::size_t n) {
    double& x = p.data(column::x)[n];
    if (x < slab || x > slab + spacing) return;
    x -= 0.8 * spacing;
    ++pushed;
  });
  EXPECT_GT(pushed, 100.0);
  move_on(ground, 1);
  EXPECT_EQ(ground.particle_count(), particles);
  const Matrix3X& x = ground.surface().x;
  EXPECT_GE(x.row(0).minCoeff(), slab - 1e-9);
  EXPECT_LE(x.row(0).maxCoeff(), slab + length + 1e-9);
}

TEST(MovingSheet, RestartContinuesBitwise) {
  const auto run = [](ContinuumTerrain& ground, int from, int to) {
    for (int n = from; n < to; ++n) {
      ground.follow(0.5 * length + 0.04 * slab * n);
      ground.surface().clear_forces();
      ground.surface().f.row(2).setConstant(-0.5);
      ground.advance(step);
    }
  };
  ContinuumTerrain whole(moving_ground(), Communicator()), first(moving_ground(), Communicator()),
      continued(moving_ground(), Communicator());
  run(whole, 0, 150);
  run(first, 0, 85);
  test::restore(continued, test::state_of(first));
  EXPECT_EQ(continued.surface().x, first.surface().x);
  run(continued, 85, 150);
  EXPECT_GT(whole.dropped_slabs(), 4u);
  EXPECT_GT(first.dropped_slabs(), 1u);
  EXPECT_EQ(test::state_of(continued), test::state_of(whole));
  EXPECT_EQ(continued.surface().x, whole.surface().x);
}

void expect_refusal(const TerrainParameters& parameters, const std::string& text) {
  EXPECT_THAT(test::error_of<InputError>(
                  [&] { const ContinuumTerrain ground(parameters, Communicator()); }),
              HasSubstr(text));
}

TEST(MovingSheet, SlabsAreWholeCells) {
  TerrainParameters parameters = moving_ground();
  parameters.slabs = 5;
  expect_refusal(parameters,
                 "has 16 cells along x in 5 slabs; allowed: slabs of a whole number of "
                 "cells; make 'length' 0.75 or 1 m");
  parameters.slabs = 0;
  expect_refusal(parameters,
                 "follows a body and has a surface mesh; allowed: a terrain that moves by slabs");
}

}  // namespace
}  // namespace furrow::moving_sheet_test
