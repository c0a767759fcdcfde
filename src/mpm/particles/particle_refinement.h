// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Division of particles along x where cells become short, and their union where cells become long.
/// A window with a graded x axis needs both when it moves (theory: continuum, eqs. 17 to 19).
///
/// Undisturbed ground is laid in particles that are 2^halvings times as long as those of the fine
/// cells. A particle keeps as many ids as it has such parts, from its own on. Halves share them
/// out, so that a particle's id and length name the one with which it was divided.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "furrow/mpm/grid/discretisation.h"
#include "furrow/mpm/ground/terrain_parameters.h"

namespace furrow {

/// Axis of a window with cells of one length around what it follows, and its number of halvings.
struct FollowingAxis {
  AxisLayout layout;
  int halvings;
};
/// Axis with stepped cells, which moves on by strides of 2^halvings fine cells, at most as long as
/// its last cell. The fine stretch is a stride longer than asked for, because what the window
/// follows is up to half a stride from the middle. The length is rounded to whole strides.
/// @param wanted  fine stretch and length; without room for longer cells the result is uniform
FollowingAxis following_axis(const AxisLayout& wanted, const std::string& where);

class ParticleRefinement {
 public:
  /// @throws InputError naming `where` for ground that particles of several lengths do not fill
  ParticleRefinement(const TerrainParameters& parameters, const Grid& grid,
                     const std::string& where);

  /// Divides and unites this rank's particles by the lengths of their cells; they must then be
  /// sorted. Particles that touch a body stay as they are. Not collective.
  void refine(std::vector<ParticleGroup>& groups) const;

 private:
  /// Length of a particle over that of one in the fine cells: a power of 2.
  long parts(const Particles& particles, std::size_t p) const;
  double length_wanted(const Particles& particles, std::size_t p) const;
  void divide(ParticleGroup& group) const;
  bool unite(ParticleGroup& group) const;
  bool may_unite(const ParticleGroup& group, std::size_t a, std::size_t b) const;

  const Axis& x_;
  std::array<int, 3> particles_per_cell_;
  long maximum_parts_;
};

/// True if two particles of one material may become one: their density, stress and internal
/// variables differ by little.
bool are_alike(const ParticleGroup& group, std::size_t a, std::size_t b);

}  // namespace furrow
