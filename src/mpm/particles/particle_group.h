// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The particles of a terrain, by material.

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "furrow/material/material.h"
#include "furrow/mpm/particles/particles.h"

namespace furrow {

/// A half-open range of particles.
struct ParticleRange {
  std::size_t from = 0, to = 0;
};

/// All particles of one material (one layer) on this rank; of those on one side of a slide surface
/// or in one region between thin parts, where there are any.
struct ParticleGroup {
  std::shared_ptr<const Material> material;
  Particles particles;
  std::size_t layer = 0;  ///< from the top
  int field = 0;          ///< of the velocity fields of the grid
  /// ranges that are computed, in their order (active_ground.h); without: all
  std::optional<std::vector<ParticleRange>> awake = {};
  /// where `awake` is given: first particle of each column of cells at the last sorting, y running
  /// fastest, and the number of particles
  std::vector<std::size_t> column_start = {};

  /// Calls visit(from, to) for the ranges that are computed.
  template <class Visit>
  void for_awake(Visit&& visit) const {
    if (!awake) {
      visit(std::size_t(0), particles.size());
      return;
    }
    for (const ParticleRange& range : *awake) visit(range.from, range.to);
  }
  /// Fastest wave in the particles of a range [m/s].
  double largest_wave_speed(std::size_t from, std::size_t to) const;
  double mass(std::size_t particle) const {  ///< [kg]
    return material->density() * particles.data(column::volume)[particle];
  }
};

/// A particle of this rank; valid until particles change their order
/// (ContinuumTerrain::generation).
struct ParticleIndex {
  std::size_t group;
  std::size_t particle;
};

}  // namespace furrow
