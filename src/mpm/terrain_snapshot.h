// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The ground at one instant, as files and pictures need it.

#include <string>
#include <utility>
#include <vector>

#include "core/types.h"
#include "mpm/continuum_terrain.h"

namespace furrow {

/// Particles of all ranks and layers in the order of their ids.
struct TerrainSnapshot {
  std::vector<double> id;
  Matrix3X x, initial_position, v;      ///< position now and at the start [m], velocity [m/s]
  std::vector<double> layer;            ///< 0 on top
  std::vector<double> volume, density;  ///< now [m^3], [kg/m^3]
  std::vector<double> pressure, mises;  ///< p (compression positive) and q [Pa]
  std::vector<double> vertical_stress;  ///< sigma_zz, tension positive [Pa]
  std::vector<double> compaction;       ///< eps_vol_pl of laws that have it, otherwise -ln J
  std::size_t size() const { return id.size(); }
};

/// Collective; every rank gets all.
TerrainSnapshot take_snapshot(ContinuumTerrain& ground);
/// What the moving ground dropped, of all ranks. Collective.
std::vector<RutPoint> collect_rut(const ContinuumTerrain& ground);

}  // namespace furrow
