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

#include "bodies/rigid_wheel.h"
#include "bodies/coupled_system.h"
#include "io/material_file.h"
#include "mpm/contact/terrain_contact.h"
#include "mpm/continuum_terrain.h"
#include "rig/wheel_rig.h"

namespace furrow {
namespace {

/// Processor time: what other programs take does not count.
double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

int run(int argc, char** argv) {
  const double cell = argc > 1 ? std::atof(argv[1]) : 0.025,
               roll = argc > 2 ? std::atof(argv[2]) : 0.3;
  const std::string material =
      argc > 3 ? argv[3] : FURROW_SOURCE_DIR "/inputs/materials/fresh_snow.yaml";
  const double depth = 0.20, half_length = 0.8, half_width = 0.4;

  TerrainParameters ground;
  ground.layers = {{std::shared_ptr<const Material>(load_material(material)), depth}};
  ground.surface = depth;
  ground.x = {-half_length, half_length, cell, -half_length, half_length, 1.0};
  ground.y = {0.0, half_width, cell, 0.0, half_width, 1.0};
  ground.z = {0.0, depth + 6 * cell, cell, 0.0, depth + 6 * cell, 1.0};
  ground.window = true;
  if (argc > 5) ground.remap_interval = std::atoi(argv[5]);
  if (argc > 4) ground.cfl = std::atof(argv[4]);
  ContinuumTerrain soil(ground, Communicator());

  RigidWheelParameters parameters;
  parameters.geometry.diameter = 0.74;
  parameters.geometry.width = 0.272;
  parameters.geometry.shoulder = 0.051;
  parameters.hub = {{636.0, 2.15, 1.5}, {0.0, 0.0, depth + 0.37 + 0.005}};
  RigidWheel wheel(parameters);
  WheelRig rig(WheelRig::schema().read({"load_mass", "636", "speed", "2.2352", "mode", "slip",
                                        "slip", "0", "settle_time", "0.3", "load_ramp_time", "0.3",
                                        "accelerate_time", "0.15", "ground_level",
                                        fmt::format("{}", depth), "damping", "3000"}),
               wheel);
  TerrainContact contact(wheel, soil, ContactParameters{}, true, "contact");
  CoupledSystem system;
  system.add(wheel, "wheel");
  system.add(soil, "ground");
  system.add(contact, "contact");

  const double interval = 2e-4;
  double time = 0.0, updates = 0.0, start = seconds(), last = start;
  long sub_steps = 0;
  double fx = 0.0, fz = 0.0, sinkage = 0.0, count = 0.0;
  const double end = 0.3 + 0.15 + (roll - 0.5 * 0.15 * 2.2352) / 2.2352;
  for (long step = 0; time < end; ++step) {
    rig.apply(time, interval);
    soil.follow(wheel.centre().x());
    const int n = system.advance(interval);
    time += interval;
    sub_steps += n;
    updates += n * soil.particle_count();
    if (wheel.centre().x() > 0.6 * roll) {
      fx += contact.force().x();
      fz += contact.force().z();
      sinkage += depth - wheel.lowest_point();
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
          time, wheel.centre().x(), depth - wheel.lowest_point(), contact.force().z(),
          contact.force().x(), contact.penetration(), contact.contacts(), b.contact_work,
          b.kinetic_energy, b.stored_energy, b.dissipated_energy, b.numerical_loss, b.residual(),
          updates / (last - start) * 1e-6);
      std::fflush(stdout);
    }
  }
  const double wall = seconds() - start;
  fmt::print(
      "particles {:.0f}, sub-steps {}, step {:.2e} s, processor {:.1f} s, {:.2f} M updates/s\n",
      soil.particle_count(), sub_steps, time / sub_steps, wall, updates / wall * 1e-6);
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
