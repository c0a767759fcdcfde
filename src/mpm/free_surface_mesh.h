// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The upper face of continuum ground as triangles: what grains lie on in a hybrid.

#include <vector>

#include "geometry/surface.h"
#include "mpm/particles.h"

namespace furrow {

struct GroundPhase;

/// A node rides on a particle of the uppermost level, half a spacing (shrunk with its volume) above
/// it; along the rim of the ground it is half a spacing further out as well, on the face of the
/// grid. It has the ground's affine velocity there, and the force on it goes back to the grid as
/// the force of a contact does: at the node, by the particle's own weights, so that force and
/// moment are kept.
class GroundSheet {
 public:
  GroundSheet() = default;
  /// @param ids of the uppermost particles, ascending: `columns` across x, in each of them `rows`
  /// along y
  GroundSheet(std::vector<double> ids, std::size_t rows, std::size_t columns);

  bool exists() const { return !ids_.empty(); }
  Surface& surface() { return surface_; }
  const Surface& surface() const { return surface_; }
  /// Finds this rank's particles anew; after they changed places.
  void find(const std::vector<GroundPhase>& phases);
  /// Takes place and velocity of the particles; sums over ranks make them known everywhere.
  template <class Sum>
  void follow(const std::vector<GroundPhase>& phases, Sum&& sum) {
    place(phases);
    sum(numbers_.data(), numbers_.size());
    take();
  }
  /// Calls push(GroundPoint, force, point) for every node that carries a force here.
  template <class Push>
  void hand_over(const std::vector<GroundPhase>& phases, Push&& push) const {
    for (const Seat& seat : seats_)
      if (surface_.f.col(seat.node).squaredNorm() > 0.0)
        push({seat.phase, seat.particle}, Vector3(surface_.f.col(seat.node)),
             point_of(phases, seat));
  }

 private:
  struct Seat {
    Eigen::Index node;
    std::size_t phase, particle;
  };
  Vector3 lever(const std::vector<GroundPhase>& phases, const Seat& seat) const;
  Vector3 point_of(const std::vector<GroundPhase>& phases, const Seat& seat) const;
  void place(const std::vector<GroundPhase>& phases);
  void take();

  std::vector<double> ids_;  // ascending
  Matrix3X reach_;           // of a node beyond its particle, in half spacings
  std::vector<Seat> seats_;  // of this rank
  std::vector<double> numbers_;
  Surface surface_;
};

}  // namespace furrow
