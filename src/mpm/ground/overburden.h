// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The state of undisturbed ground under its own weight.

#include <vector>

#include "furrow/mpm/ground/terrain_parameters.h"

namespace furrow {

/// One level of particles, from the surface down.
struct ParticleLevel {
  double z = 0.0;     ///< [m]
  double half = 0.0;  ///< half the height of ground that it stands for [m]
  std::size_t layer = 0;
  VectorX state;  ///< of the material
};

/// Compresses every level without lateral strain, each layer from the initial state of its
/// material, until its vertical stress carries the weight above, surcharge included: stress,
/// density and hardening then belong together in any material. Without initial_stress the levels
/// have the initial state.
/// @param surcharge  weight on the uppermost level [Pa]
/// @param levels  z and half, from the surface down; layer and state are filled in
/// @param patch  0: the ground before all patches
/// @throws InputError when a material cannot carry the weight
void find_overburden(const TerrainParameters& parameters, double surcharge,
                     std::vector<ParticleLevel>& levels, std::size_t patch = 0);

}  // namespace furrow
