// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Ground that moves along with a body: removed behind, added ahead. It moves by a layer of cells;
/// on a graded x axis by a stride of fine cells; and with a surface mesh by a slab of many layers.

#include <string>
#include <vector>

#include "furrow/core/checkpoint.h"
#include "furrow/mpm/grid/boundary.h"
#include "furrow/mpm/grid/discretisation.h"
#include "furrow/mpm/particles/particle_distribution.h"
#include "furrow/mpm/ground/rut_record.h"
#include "furrow/mpm/terrain_energy.h"
#include "furrow/mpm/ground/terrain_fill.h"
#include "furrow/mpm/ground/terrain_parameters.h"

namespace furrow {

class MovingWindow {
 public:
  /// All parts must outlive the window. @param where  names the terrain in errors
  /// @throws InputError for a window with a graded x axis that following_axis() did not make, with
  /// a surface mesh and no slabs, or with slabs of no whole number of cells
  MovingWindow(const TerrainParameters& parameters, Discretisation& discretisation,
               const ParticleDistribution& distribution, Boundary& boundary, TerrainFill& fill,
               TerrainEnergy& energy, const std::string& where);

  /// The middle of the window is to follow this x [m].
  void follow(double x) { followed_x_ = x; }
  /// Moves until the middle is within a cell (a slab, half a stride) of what it follows. Particles
  /// must be up to date with the grid. Collective. @return whether it moved: particles must then be
  /// sorted
  /// @throws StateError when a particle to be removed is outside of the grid
  bool move();

  double travelled() const;           ///< of the grid since the start [m]
  std::size_t dropped_slabs() const;  ///< since the start
  const RutRecord& rut() const { return rut_; }

  /// Brings the grid back to where it was; to be restored before whatever depends on it.
  void checkpoint_position(Checkpoint& state);
  void checkpoint_rut(Checkpoint& state);  ///< collective

 private:
  double lead() const;
  double first_layer_end() const;
  void move_by_layer();
  void remove_first_layer();
  void check(const TerrainParameters& parameters, const std::string& where) const;
  void record_rut(const std::vector<double>& top, const std::vector<double>& mass,
                  const std::vector<double>& volume);

  bool enabled_;
  int stride_ = 1;         // layers that it moves by at a time
  int cells_;              // fine cells of a layer
  std::size_t per_cell_;   // columns of particles
  bool has_surface_mesh_;  // true with nodes attached to particles
  Discretisation& discretisation_;
  const ParticleDistribution& distribution_;
  Boundary& boundary_;
  TerrainFill& fill_;
  TerrainEnergy& energy_;
  double followed_x_;  // [m]
  double start_;       // lower end of the grid at the start [m]
  int shifts_ = 0;     // in fine cells
  RutRecord rut_;
};

}  // namespace furrow
