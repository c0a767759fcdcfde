// SPDX-License-Identifier: GPL-2.0-or-later
// Cost of continuum terrain: the rigid wheel of [Shoop2001] (half model, moving terrain) rolls over
// 0.20 m of snow; particle updates per second on one core while rolling, and the sinkage and
// resistance of that stretch for orientation.
//   build/tests/benchmarks/ground_update [cell in m] [metres of rolling] [material file] [cfl]
//   [remap interval]
// The environment variable FURROW_ISA = baseline | avx2 | avx512 selects the kernels.

#include <ctime>
#include <cstdlib>

#include <fmt/format.h>

#include "../support/wheel_on_ground.h"

namespace furrow {
namespace {

/// Processor time: what other programs take does not count.
double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

int run(int argc, char** argv) {
  WheelOnGround::Ground ground;
  ground.cell = argc > 1 ? std::atof(argv[1]) : 0.025;
  const double roll = argc > 2 ? std::atof(argv[2]) : 0.3;
  if (argc > 3) ground.material = argv[3];
  if (argc > 4) ground.cfl = std::atof(argv[4]);
  if (argc > 5) ground.remap_interval = std::atoi(argv[5]);
  WheelOnGround scene(ground);
  ContinuumTerrain& soil = scene.soil();
  const TerrainContact& contact = scene.contact();

  double updates = 0.0, start = seconds(), last = start;
  long sub_steps = 0;
  double fx = 0.0, fz = 0.0, sinkage = 0.0, count = 0.0;
  while (scene.time() < WheelOnGround::end_of(roll)) {
    const int n = scene.step();
    sub_steps += n;
    updates += n * soil.particle_count();
    if (scene.travel() > 0.6 * roll) {
      fx += contact.force().x();
      fz += contact.force().z();
      sinkage += scene.sinkage();
      count += 1.0;
    }
    if (seconds() - last > 5.0) {
      last = seconds();
      const EnergyBudget b = soil.energy_budget();
      fmt::print(
          "t {:.3f} x {:.3f} sinkage {:.4f} Fz {:.0f} Fx {:.0f} penetration {:.1e} contacts {} | E "
          "contact {:.1f} kin "
          "{:.2f} stored {:.2f} diss {:.2f} num {:.2f} "
          "resid {:.3f} | rate {:.2f} M/s\n",
          scene.time(), scene.travel(), scene.sinkage(), contact.force().z(), contact.force().x(),
          contact.penetration(), contact.contacts(), b.contact_work, b.kinetic_energy,
          b.stored_energy, b.dissipated_energy, b.numerical_loss, b.residual(),
          updates / (last - start) * 1e-6);
      std::fflush(stdout);
    }
  }
  const double wall = seconds() - start;
  fmt::print(
      "particles {:.0f}, sub-steps {}, step {:.2e} s, processor {:.1f} s, {:.2f} M updates/s\n",
      soil.particle_count(), sub_steps, scene.time() / sub_steps, wall, updates / wall * 1e-6);
  const EnergyBudget b = soil.energy_budget();
  fmt::print(
      "sinkage {:.4f} m, resistance coefficient {:.4f}, load {:.0f} N, numerical loss {:.1f} of "
      "{:.1f} J\n",
      sinkage / count, -fx / fz, fz / count, b.numerical_loss, b.contact_work);
  return 0;
}

}  // namespace
}  // namespace furrow

int main(int argc, char** argv) { return furrow::run(argc, argv); }
