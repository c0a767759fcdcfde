// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The rigid wheel of [Shoop2001] rolls over 0.2 m of ground that moves along with it (half model,
/// without slip), for tests and benchmarks.

#include <optional>

#include <fmt/format.h>

#include "furrow/bodies/coupled_system.h"
#include "furrow/bodies/rigid_wheel.h"
#include "furrow/io/inputs/material_file.h"
#include "furrow/mpm/contact/terrain_contact.h"
#include "furrow/mpm/continuum_terrain.h"
#include "furrow/rig/wheel_rig.h"

namespace furrow {

class WheelOnGround {
 public:
  static constexpr double depth = 0.2, radius = 0.37, width = 0.272;  // [m]
  static constexpr double speed = 2.2352;                             // [m/s]
  static constexpr double mass = 636.0, load = mass * 9.80665;        // [kg], [N]

  struct Ground {
    double cell = 0.04, length = 1.6, half_width = 0.4;  ///< [m]
    std::string material = FURROW_SOURCE_DIR "/inputs/materials/fresh_snow.yaml";
    double cfl = TerrainParameters{}.cfl;
    int remap_interval = TerrainParameters{}.remap_interval;
    std::optional<BlockLayout> blocks = {};
  };

  explicit WheelOnGround(const Ground& ground, const Communicator& ranks = Communicator())
      : soil_(terrain(ground), ranks),
        wheel_(parameters()),
        rig_(WheelRig::schema().read(
                 {"load_mass", fmt::to_string(mass), "speed", fmt::to_string(speed), "mode", "slip",
                  "slip", "0", "settle_time", fmt::to_string(settle_time), "load_ramp_time",
                  fmt::to_string(settle_time), "accelerate_time", fmt::to_string(accelerate_time),
                  "ground_level", fmt::to_string(depth), "damping", "3000"}),
             wheel_),
        contact_(wheel_, soil_, ContactParameters{}, true, "contact") {
    system_.add(wheel_, "wheel");
    system_.add(soil_, "ground");
    system_.add(contact_, "contact");
  }

  /// One step of a scene. @return its sub-steps
  int step() {
    constexpr double interval = 2e-4;
    rig_.apply(time_, interval);
    soil_.follow(wheel_.centre().x());
    const int sub_steps = system_.advance(interval);
    time_ += interval;
    return sub_steps;
  }
  /// When the wheel has rolled a distance [m] [s].
  static double end_of(double distance) {
    return settle_time + 0.5 * accelerate_time + distance / speed;
  }

  double time() const { return time_; }                       ///< [s]
  double travel() const { return wheel_.centre().x(); }       ///< [m]
  double sinkage() { return depth - wheel_.lowest_point(); }  ///< [m]
  ContinuumTerrain& soil() { return soil_; }
  const TerrainContact& contact() const { return contact_; }

 private:
  static constexpr double settle_time = 0.3, accelerate_time = 0.15;  // [s]

  static TerrainParameters terrain(const Ground& ground) {
    const double half = 0.5 * ground.length, top = depth + 6 * ground.cell;
    TerrainParameters terrain;
    terrain.layers = {{std::shared_ptr<const Material>(load_material(ground.material)), depth}};
    terrain.surface = depth;
    terrain.x = {-half, half, ground.cell, -half, half, 1.0};
    terrain.y = {0.0, ground.half_width, ground.cell, 0.0, ground.half_width, 1.0};
    terrain.z = {0.0, top, ground.cell, 0.0, top, 1.0};
    terrain.window = true;
    terrain.cfl = ground.cfl;
    terrain.remap_interval = ground.remap_interval;
    terrain.blocks = ground.blocks;
    return terrain;
  }
  static RigidWheelParameters parameters() {
    RigidWheelParameters wheel;
    wheel.geometry.diameter = 2.0 * radius;
    wheel.geometry.width = width;
    wheel.geometry.shoulder = 0.051;
    wheel.hub = {{mass, 2.15, 1.5}, {0.0, 0.0, depth + radius + 0.005}};
    return wheel;
  }

  ContinuumTerrain soil_;
  RigidWheel wheel_;
  WheelRig rig_;
  TerrainContact contact_;
  CoupledSystem system_;
  double time_ = 0.0;
};

}  // namespace furrow
