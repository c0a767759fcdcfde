// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Base of fixes whose body is continuum terrain.

#include <string>
#include <utility>
#include <vector>

#include "coupling/base/fix_body.h"
#include "coupling/base/roles/ground.h"
#include "furrow/mpm/continuum_terrain.h"

namespace furrow::coupling {

class FixTerrain : public FixBody, public Terrain {
 public:
  ContinuumTerrain& terrain() const { return static_cast<ContinuumTerrain&>(body()); }
  bool half_model() const { return options().flag("symmetry"); }
  /// Factor from sums over the computed half to outputs, which are those of the whole terrain.
  double symmetry_factor() const { return half_model() ? 2.0 : 1.0; }
  bool moves() const override { return options().given("follow"); }
  std::pair<double, double> extent(int direction) const override;
  /// True if a point lies in the undisturbed terrain, whose trough is no part of it.
  bool contains(const Vector3& point) const;

  const Options& line() const override { return options(); }
  double level() const override { return terrain().parameters().surface; }
  std::vector<GivenGravity> gravities() const override;
  double checkpoint_size() const override { return terrain().checkpoint_size(); }
  Vector3 shortest_cell() const override;
  /// Half of the ground has half of the cells along y.
  Vector3 cells_across(const Vector3& lower, const Vector3& upper) const override;
  std::string finer_cells() const override {
    return "choose smaller cells, and a larger fine_width if there is one";
  }
  KnownContact known_contact() const override;
  void tilt_gravity(const Matrix3& tilt) override;
  double particle_count() const override { return terrain().particle_count(); }
  std::vector<ParticleGroup*> particle_groups() override;

  std::string title() const override { return "terrain"; }
  std::string series() const override { return "terrain"; }
  std::vector<Channel> channels() const override;
  std::vector<double> values() override;
  std::variant<TerrainSnapshot, Surface> snapshot() override { return take_snapshot(terrain()); }
  std::vector<RutPoint> rut() const override { return collect_rut(terrain()); }
  std::optional<EnergyBudget> energy_budget() const override { return terrain().energy_budget(); }
  const Surface& surface() override { return body().surface(); }

  /// Restores the terrain without keeping a copy as its script line makes it.
  void restart(char* buffer) override { FurrowFix::restart(buffer); }

 protected:
  using FixBody::FixBody;
  /// The particles of each rank go to its own file.
  void checkpoint(Checkpoint& state) override;
};

}  // namespace furrow::coupling
