// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The terrain at one instant, as files and pictures need it.

#include <vector>

#include "furrow/core/types.h"
#include "furrow/mpm/continuum_terrain.h"

namespace furrow {

/// Particles of all ranks and layers in the order of their ids.
struct TerrainSnapshot {
  std::vector<double> id;
  Matrix3X x;                           ///< position now [m]
  Matrix3X initial_position;            ///< [m]
  Matrix3X v;                           ///< velocity [m/s]
  std::vector<double> layer;            ///< 0 on top
  std::vector<double> volume;           ///< now [m^3]
  std::vector<double> density;          ///< now [kg/m^3]
  std::vector<double> pressure;         ///< p, compression positive [Pa]
  std::vector<double> mises;            ///< q [Pa]
  std::vector<double> vertical_stress;  ///< sigma_zz, tension positive [Pa]
  Matrix3X principal_stress;            ///< largest first, tension positive [Pa]
  Matrix3X tension_axis;                ///< direction of the first, of length 1, z >= 0
  Matrix3X compression_axis;            ///< of the last
  std::vector<double> compaction;       ///< eps_vol_pl of materials that have it, otherwise -ln J
  std::vector<double> plastic_strain;   ///< eps_dev_pl of materials that have it, otherwise 0
  std::size_t size() const { return id.size(); }
};

/// Takes a snapshot on the first rank; the others get nothing. Collective.
TerrainSnapshot take_snapshot(ContinuumTerrain& terrain);
/// Rut that the moving window left behind, of all ranks. Collective.
std::vector<RutPoint> collect_rut(const ContinuumTerrain& terrain);

}  // namespace furrow
