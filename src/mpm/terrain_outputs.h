// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Outputs of continuum terrain: f_ID[n] of terrain/continuum, and the channels of
/// terrain/history.

#include <algorithm>
#include <optional>

#include "furrow/bodies/body.h"
#include "furrow/core/options/outputs.h"
#include "furrow/mpm/continuum_terrain.h"

namespace furrow {

/// A terrain whose sums over the ranks are made once, when an output asks for them.
class TerrainReading {
 public:
  explicit TerrainReading(const ContinuumTerrain& terrain) : terrain_(terrain) {}

  const ContinuumTerrain& terrain() const { return terrain_; }
  /// Collective.
  const EnergyBudget& energy() {
    if (!energy_) energy_ = terrain_.energy_budget();
    return *energy_;
  }
  /// Force and energy that sleeping ground neglects; zero where all of the ground is computed.
  ActiveGround::Neglect neglect() const {
    return terrain_.active() ? terrain_.active()->neglect() : ActiveGround::Neglect{};
  }
  /// Traffic of a rank in a sub-step. Collective.
  const HaloTraffic& halo() {
    if (!halo_) {
      const HaloTraffic all = terrain_.halo_traffic();
      const double steps = std::max(all.steps, 1.0);
      halo_ = {1.0, all.messages / steps, all.bytes / steps};
    }
    return *halo_;
  }

 private:
  const ContinuumTerrain& terrain_;
  std::optional<EnergyBudget> energy_;
  std::optional<HaloTraffic> halo_;
};

/// The functions are collective. Energies since the start; of a half model, of the half.
const Outputs<TerrainReading>& terrain_outputs();

}  // namespace furrow
