// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Broad phase of a contact: finds which particles may touch which triangles of a surface.

#include <optional>
#include <vector>

#include "furrow/bodies/body.h"
#include "furrow/mpm/continuum_terrain.h"

namespace furrow {

class TriangleSearch;

/// Deepest penetration that a contact can follow, of the shortest cell.
constexpr double max_penetration_cells = 0.5;

/// A neighbour list with a skin: what a search finds stays valid until surface and ground have
/// moved towards each other by the skin (L. Verlet, Phys. Rev. 159, 1967), or particles have
/// changed their order. The contacts that are found do not depend on when the search is repeated:
/// a search is no part of a checkpoint. Lists this rank's particles; no call is collective.
class ContactSearch {
 public:
  /// A triangle near a particle when it was searched.
  struct NearTriangle {
    double distance;  ///< [m]
    int triangle;
  };
  struct Candidate {
    ParticleIndex particle;
    Vector3 position;  ///< position at the search [m]
    /// its triangles in near_triangles(), the nearest first
    std::size_t first;
    std::size_t last;
  };

  /// Body and terrain must outlive the search.
  ContactSearch(const Body& body, ContinuumTerrain& terrain);

  /// Measures how far the surface has moved since the last search. @return whether to search again
  bool is_outdated();
  /// Finds the candidates at the present positions.
  void search();
  /// Particles may travel so much further before the next call of is_outdated() [m].
  void add_terrain_travel(double distance) { terrain_travel_ += distance; }

  const std::vector<Candidate>& candidates() const { return candidates_; }
  const NearTriangle& near_triangle(std::size_t n) const { return near_triangles_[n]; }
  /// Travel of the surface's fastest node since the last search [m].
  double surface_travel() const { return surface_travel_; }
  /// A candidate is no nearer to the surface than this now [m].
  double lower_bound(const Candidate& candidate) const {
    return near_triangles_[candidate.first].distance - surface_travel_ - terrain_travel_ -
           staleness_;
  }

 private:
  double largest_particle_reach() const;
  void find_candidates();
  void add_candidate(const TriangleSearch& triangles, const ParticleIndex& particle,
                     const Vector3& position, double reach);

  const Body& body_;
  ContinuumTerrain& terrain_;
  std::vector<Candidate> candidates_;
  std::vector<NearTriangle> near_triangles_;
  // State at the last search.
  std::optional<unsigned long> generation_;  // of the terrain; none: there was no search yet
  Matrix3X searched_nodes_;                  // of the surface [m]
  double skin_ = 0.0;                        // [m]
  double staleness_ = 0.0;                   // of the positions [m]
  // Travel since the last search.
  double surface_travel_ = 0.0;  // [m]
  double terrain_travel_ = 0.0;  // bound [m]
};

}  // namespace furrow
