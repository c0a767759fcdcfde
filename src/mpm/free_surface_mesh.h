// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The upper face of continuum ground as triangles: what grains lie on in a hybrid.

#include <vector>

#include "geometry/surface.h"
#include "mpm/particles.h"

namespace furrow {

struct ParticleGroup;

/// A node rides on a particle of the uppermost level, half a spacing (shrunk with its volume) above
/// it; along the rim of the ground it is half a spacing further out as well, on the face of the
/// grid. It has the ground's affine velocity there, and the force on it goes back to the grid as
/// the force of a contact does: at the node, by the particle's own weights, so that force and
/// moment are kept.
class FreeSurfaceMesh {
 public:
  FreeSurfaceMesh() = default;
  /// @param ids of the uppermost particles, ascending: `columns` across x, in each of them `rows`
  /// along y
  FreeSurfaceMesh(std::vector<double> ids, std::size_t rows, std::size_t columns);

  bool exists() const { return !ids_.empty(); }
  Surface& surface() { return surface_; }
  const Surface& surface() const { return surface_; }
  /// Finds this rank's particles anew; after they changed places.
  void relocate(const std::vector<ParticleGroup>& groups);
  /// Takes place and velocity of the particles; sums over ranks make them known everywhere.
  template <class Sum>
  void follow(const std::vector<ParticleGroup>& groups, Sum&& sum) {
    pack(groups);
    sum(numbers_.data(), numbers_.size());
    unpack();
  }
  /// Calls add_point_force(ParticleIndex, force, point) for every node that carries a force here.
  template <class AddPointForce>
  void scatter_forces(const std::vector<ParticleGroup>& groups,
                      AddPointForce&& add_point_force) const {
    for (const NodeAttachment& attachment : attachments_)
      if (surface_.f.col(attachment.node).squaredNorm() > 0.0)
        add_point_force({attachment.group, attachment.particle},
                        Vector3(surface_.f.col(attachment.node)), point_of(groups, attachment));
  }

 private:
  struct NodeAttachment {
    Eigen::Index node;
    std::size_t group, particle;
  };
  Vector3 offset(const std::vector<ParticleGroup>& groups, const NodeAttachment& attachment) const;
  Vector3 point_of(const std::vector<ParticleGroup>& groups,
                   const NodeAttachment& attachment) const;
  void pack(const std::vector<ParticleGroup>& groups);
  void unpack();

  std::vector<double> ids_;                  // ascending
  Matrix3X reach_;                           // of a node beyond its particle, in half spacings
  std::vector<NodeAttachment> attachments_;  // of this rank
  std::vector<double> numbers_;
  Surface surface_;
};

}  // namespace furrow
