// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The fields of a terrain's particles, as every file names them.

#include <array>

#include "furrow/mpm/terrain_snapshot.h"

namespace furrow {

/// One field of TerrainSnapshot.
template <class Values>
struct TerrainField {
  const char* name;
  const char* unit;
  const char* meaning;
  Values TerrainSnapshot::*values;
};

inline constexpr std::array<TerrainField<std::vector<double>>, 9> scalar_terrain_fields{{
    {"id", "", "number of the particle", &TerrainSnapshot::id},
    {"layer", "", "counted from 0 at the top", &TerrainSnapshot::layer},
    {"volume", "m^3", "of the particle now", &TerrainSnapshot::volume},
    {"density", "kg/m^3", "now", &TerrainSnapshot::density},
    {"pressure", "Pa", "mean stress, compression positive", &TerrainSnapshot::pressure},
    {"mises", "Pa", "q = sqrt(3 J2)", &TerrainSnapshot::mises},
    {"vertical_stress", "Pa", "sigma_zz, tension positive", &TerrainSnapshot::vertical_stress},
    {"compaction", "", "compressive volumetric plastic strain, or -ln J of laws without one",
     &TerrainSnapshot::compaction},
    {"plastic_strain", "", "equivalent deviatoric plastic strain, 0 of laws without one",
     &TerrainSnapshot::plastic_strain},
}};

inline constexpr std::array<TerrainField<Matrix3X>, 6> vector_terrain_fields{{
    {"x", "m", "position now", &TerrainSnapshot::x},
    {"initial_position", "m", "position at the start", &TerrainSnapshot::initial_position},
    {"v", "m/s", "velocity now", &TerrainSnapshot::v},
    {"principal_stress", "Pa", "largest first, tension positive",
     &TerrainSnapshot::principal_stress},
    {"tension_axis", "", "direction of the first principal stress", &TerrainSnapshot::tension_axis},
    {"compression_axis", "", "direction of the last principal stress",
     &TerrainSnapshot::compression_axis},
}};

}  // namespace furrow
