// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The particles of a terrain, by material.

#include <cstddef>
#include <memory>

#include "material/material.h"
#include "mpm/particles.h"

namespace furrow {

/// All particles of one material (one layer) on this rank; of those on one side of a slide surface,
/// where there is one.
struct ParticleGroup {
  std::shared_ptr<const Material> material;
  Particles particles;
  std::size_t layer = 0;  ///< from the top
  int field = 0;          ///< of the velocity fields of the grid

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
