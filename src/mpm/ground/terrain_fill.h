// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Undisturbed ground: the grid of a terrain and the particles that fill its cells at the start and
/// ahead of a moving window.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "furrow/core/checkpoint.h"
#include "furrow/mpm/grid/boundary.h"
#include "furrow/mpm/grid/discretisation.h"
#include "furrow/mpm/ground/overburden.h"
#include "furrow/mpm/ground/terrain_parameters.h"
#include "furrow/mpm/ground/trough.h"

namespace furrow {

/// @param where  names the terrain in errors
/// @throws InputError for axes that cannot be, or a surface inside a cell
Grid make_grid(const TerrainParameters& parameters, const std::string& where);

/// Width of the shear band that a particle stands for: its cell [m].
/// @param half  its half spacings [m]
double band_width(const std::array<int, 3>& particles_per_cell, const Vector3& half);

class TerrainFill {
 public:
  /// @param where  names the terrain in errors
  /// @throws InputError for a material that cannot carry the weight, or a layer without particles
  TerrainFill(const TerrainParameters& parameters, const Grid& grid, const std::string& where);

  /// Elastic wave speeds at the height of each plane of nodes across z, from below.
  std::vector<WaveSpeeds> wave_speeds(const Grid& grid) const;
  /// Speed of pressure waves in the slowest layer, the largest one there [m/s].
  double slowest_wave_speed() const;

  /// Fills the whole grid, layer by layer across x: one for each cell, or one for each stride of a
  /// window with a graded axis. Appends the particles that this rank owns; ids are counted on all
  /// ranks. A slide surface gives each particle its side.
  void fill(Discretisation& discretisation);
  /// Appends the last layer again, after a move of the window.
  void add_ahead(Discretisation& discretisation);

  // Columns count along x, rows along y, levels from the surface down; how many, in the grid.
  std::size_t columns(const Grid& grid) const;
  std::size_t rows(const Grid& grid) const;
  /// The uppermost one of a row: 0, but in a trough.
  std::size_t first_level(std::size_t row) const;
  /// Number of a particle of the initial ground, whose columns continue ahead of a moving window.
  double id(const Grid& grid, std::size_t column, std::size_t row, std::size_t level) const;
  std::size_t column_of(const Grid& grid, double id) const;  ///< of the particle

  void checkpoint(Checkpoint& state);

 private:
  double stride(const Grid& grid) const { return ids_per_particle_ * grid.axis(0).fine_cell(); }
  const std::vector<ParticleLevel>& levels_at(const std::array<double, 2>& place) const;
  double height_at(const std::array<double, 2>& place) const;
  void add_layer(double lower, double thickness, Discretisation& discretisation);
  void add_stack(const std::array<double, 2>& place, const std::array<double, 2>& half_spacing,
                 double height, std::size_t row, Discretisation& discretisation);

  std::string where_;
  WaveSpeeds wave_speeds(const ParticleLevel& level) const;

  std::vector<TerrainLayer> layers_;
  std::vector<std::optional<std::size_t>> band_widths_;  // of each layer: the field that is a cell
  GroundRelief relief_;
  double base_, depth_, clearance_;  // z of the base, heights of ground and of grid above it [m]
  double shortest_cell_;             // along z [m]
  std::optional<SlideSurface> slide_;
  std::array<int, 3> particles_per_cell_;
  std::vector<ParticleLevel> levels_;  // from the surface down; before all patches
  int patch_axis_;
  std::vector<double> patch_begins_;                      // [m]
  std::vector<std::vector<ParticleLevel>> patch_levels_;  // of each patch, as many
  TroughPlace trough_;
  std::vector<ParticleLevel> levels_below_trough_;  // from its bottom down
  int ids_per_particle_;  // for the parts into which ParticleRefinement divides it
  double next_id_ = 0.0;
};

}  // namespace furrow
