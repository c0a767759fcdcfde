// SPDX-License-Identifier: GPL-2.0-or-later
// A block that touches nothing: conservation of momentum, angular momentum and energy, and its
// shape.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../../unit/mpm/terrain_scene.h"
#include "tests/support/max_error.h"

namespace furrow::free_body_test {
namespace {

using namespace testing_terrain;

constexpr double cell = 0.05;

/// Ground that fills a grid of 1 m.
TerrainParameters block(double E, double cfl = 0.4,
                        int remap_interval = TerrainParameters().remap_interval,
                        const TransferScheme& scheme = {}) {
  TerrainParameters parameters =
      box(material_of(elastic(E, 0.3, 500)), {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, cell);
  parameters.cfl = cfl;
  parameters.remap_interval = remap_interval;
  parameters.scheme = scheme;
  return parameters;
}

/// Leaves a cube of side 0.2 m in the middle.
void carve_cube(ContinuumTerrain& ground) {
  carve(ground, [](const Vector3& x) { return x.cwiseAbs().maxCoeff() < 0.1; });
}

/// Straight flight through many cells: nothing changes but the place.
TEST(FreeFlight, FreeFlightIsExact) {
  ContinuumTerrain ground(block(1e6), Communicator());
  carve_cube(ground);
  const Vector3 v(3.0, -2.0, 1.0);
  set_motion(ground, v);
  const Sums before = sums_of(ground);
  double time = 0.0;
  while (time < 0.1) {
    const double dt = ground.stable_time_step();
    ground.advance(dt);
    time += dt;
  }
  const Sums after = sums_of(ground);
  EXPECT_LT((after.centre - before.centre - time * v).norm(), 1e-13);
  EXPECT_LT((after.momentum - before.momentum).norm(), 1e-13 * before.momentum.norm());
  EXPECT_NEAR(after.kinetic / before.kinetic, 1.0, 1e-12);
  EXPECT_NEAR(after.mass / before.mass, 1.0, 1e-15);
  for_particles(ground, [&](Particles& particles, std::size_t p) {
    // stress [Pa] in a block of 1 MPa
    for (std::size_t s = 0; s < 6; ++s)
      EXPECT_LT(std::abs(particles.data(column::state + s)[p]), 1e-6);
  });
}

/// Free fall: z = z_0 - g t^2/2 as leapfrog has it, z_0 - g dt^2 n(n + 1)/2; the weight's work is
/// the kinetic energy.
TEST(FreeFlight, FreeFallUnderGravityIsExact) {
  TerrainParameters parameters = block(1e6);
  parameters.gravity = {0.0, 0.0, -standard_gravity};
  ContinuumTerrain ground(parameters, Communicator());
  carve_cube(ground);
  const Sums before = sums_of(ground);
  const double dt = 2e-4;
  const int steps = 1000;
  for (int n = 0; n < steps; ++n) ground.advance(dt);
  const double fallen = 0.5 * standard_gravity * dt * dt * steps * (steps + 1.0),
               speed = standard_gravity * dt * steps;
  EXPECT_NEAR(before.centre.z() - sums_of(ground).centre.z(), fallen, 1e-12);
  const EnergyBudget budget = ground.energy_budget();
  EXPECT_NEAR(budget.momentum.z(), -before.mass * speed, 1e-10);
  EXPECT_NEAR(budget.load_work, before.mass * standard_gravity * fallen, 1e-9 * budget.load_work);
  EXPECT_NEAR(budget.kinetic_energy, 0.5 * before.mass * speed * speed,
              1e-9 * budget.kinetic_energy);
  EXPECT_LT(std::abs(budget.residual()), 1e-10 * budget.load_work);
}

/// Losses of a spin about a slanted axis, and strain of the body, over five turns.
struct Spin {
  double momentum = 0.0, angular = 0.0, energy = 0.0, strain = 0.0;  // relative
};

Spin spin_five_turns(double speed, int remap_interval, const TransferScheme& scheme) {
  ContinuumTerrain ground(block(1e7, 0.4, remap_interval, scheme), Communicator());
  carve_cube(ground);
  const Vector3 omega = speed * Vector3(20.0, 10.0, 30.0), v(0.1, 0.0, -0.2);
  set_motion(ground, v, spin(omega));
  std::vector<Vector3> start;
  for_particles(ground, [&](Particles& particles, std::size_t p) {
    particles.data(column::initial_x)[p] = double(p);
  });
  for_particles(
      ground, [&](Particles& particles, std::size_t p) { start.push_back(particles.position(p)); });
  const Sums before = sums_of(ground);
  test::MaxError momentum, angular, strain;
  double time = 0.0;
  while (time < 5.0 * 2.0 * pi / omega.norm()) {
    const double dt = ground.stable_time_step();
    ground.advance(dt);
    time += dt;
    const Sums now = sums_of(ground);
    momentum.add((now.momentum - before.momentum).norm() / before.momentum.norm());
    angular.add((now.angular - before.angular).norm() / before.angular.norm());
  }
  const EnergyBudget budget = ground.energy_budget();
  const double energy = 1.0 - (budget.kinetic_energy + budget.stored_energy) / before.kinetic;
  // Distances between particles: elongation by the centrifugal stress rho omega^2 a^2/2 over E is
  // 1e-4.
  std::vector<Vector3> now(start.size());
  for_particles(ground, [&](Particles& particles, std::size_t p) {
    now[static_cast<std::size_t>(particles.data(column::initial_x)[p])] = particles.position(p);
  });
  for (std::size_t a = 0; a < now.size(); ++a)
    for (std::size_t b = a + 1; b < now.size(); b += 17)
      strain.add((now[a] - now[b]).norm() / (start[a] - start[b]).norm() - 1.0);
  return {momentum.max(), angular.max(), energy, strain.max()};
}

/// A scheme, and the strain that it may make between two particles.
struct SchemeCase {
  const char* name;
  TransferScheme scheme;
  double strain;
};
constexpr SchemeCase scheme_cases[] = {{"plain", {false, 0.0}, 2e-3}, {"usual", {}, 4e-3}};

/// Momenta to rounding, energy and shape, with a remap in each step.
TEST(RigidRotation, RotationKeepsMomentaEnergyAndShape) {
  for (const SchemeCase& one : scheme_cases) {
    const Spin spin = spin_five_turns(1.0, 1, one.scheme);
    RecordProperty(fmt::format("energy_lost_{}", one.name), fmt::format("{:.1e}", spin.energy));
    RecordProperty(fmt::format("strain_{}", one.name), fmt::format("{:.2e}", spin.strain));
    EXPECT_LT(spin.momentum, 1e-12) << one.name;
    EXPECT_LT(spin.angular, 1e-12) << one.name;
    EXPECT_NEAR(spin.energy, 0.0, 2e-3) << one.name;
    EXPECT_LT(spin.strain, one.strain) << one.name;
  }
}

/// With longer remap intervals momentum is still kept to rounding, and angular momentum to second
/// order in the rotation during an interval: a body that spins faster has shorter intervals, as
/// many in a turn, and loses as much.
TEST(RigidRotation, LongGridResetIntervalsLoseLittleEnergy) {
  for (const SchemeCase& one : scheme_cases)
    for (const double speed : {1.0, 0.5}) {
      const Spin spin = spin_five_turns(speed, TerrainParameters().remap_interval, one.scheme);
      RecordProperty(fmt::format("{}_at_{}", one.name, speed == 1.0 ? "full" : "half"),
                     fmt::format("angular {:.2e}, strain {:.2e}", spin.angular, spin.strain));
      EXPECT_LT(spin.momentum, 1e-12) << one.name;
      EXPECT_LT(spin.angular, 0.02) << one.name;
      EXPECT_NEAR(spin.energy, 0.0, 0.04) << one.name;
      EXPECT_LT(spin.strain, one.strain) << one.name;
    }
}

/// Under its own vibrations a free block keeps its momenta to rounding, and never gains energy.
TEST(FreeVibration, VibrationKeepsMomentaAndGainsNoEnergy) {
  ContinuumTerrain ground(block(1e6, 0.1), Communicator());
  carve_cube(ground);
  for_particles(ground, [](Particles& particles, std::size_t p) {
    const Vector3 x = particles.position(p);
    Eigen::Map<Vector3>(particles.data(column::velocity) + 4 * p) =
        Vector3(std::sin(20 * x.x()), x.y() * x.z() * 50, std::cos(15 * x.x()));
  });
  const Sums before = sums_of(ground);
  ground.advance(1e-6);  // the balance counts from here
  const EnergyBudget start = ground.energy_budget();
  const double first = start.kinetic_energy + start.stored_energy;
  double time = 0.0;
  while (time < 0.05) {
    const double dt = ground.stable_time_step();
    ground.advance(dt);
    time += dt;
    const EnergyBudget b = ground.energy_budget();
    // The nodes have no more than the particles had, part of which is residual motion; a
    // leapfrog's energies are half a step apart.
    EXPECT_LE(b.kinetic_energy + b.stored_energy, 1.02 * before.kinetic);
  }
  const Sums after = sums_of(ground);
  const EnergyBudget end = ground.energy_budget();
  EXPECT_LT((after.momentum - before.momentum).norm(), 1e-12 * before.mass);
  EXPECT_LT((after.angular - before.angular).norm(), 1e-12 * before.mass);
  EXPECT_LT(std::abs(end.residual() - start.residual()), 1e-3 * first);
  EXPECT_GT(end.numerical_loss, start.numerical_loss - (before.kinetic - first));
  RecordProperty("energy_kept",
                 fmt::format("{:.4f}", (end.kinetic_energy + end.stored_energy) / first));
}

}  // namespace
}  // namespace furrow::free_body_test
