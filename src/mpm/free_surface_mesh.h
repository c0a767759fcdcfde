// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The free surface of a terrain as triangles: what grains lie on in a hybrid.

#include <vector>

#include "core/communicator.h"
#include "geometry/surface.h"
#include "mpm/particle_group.h"
#include "mpm/point_loads.h"
#include "mpm/terrain_fill.h"

namespace furrow {

/// Each node is attached to a particle of the uppermost level, to one in so many, half a spacing
/// (shrunk with the particle's volume) above it; along the edge of the ground it is half a spacing
/// further out as well, on the face of the grid. On the sides of a trough it is half a spacing
/// beside a particle, and in the corners both. It moves with the affine velocity of the particle,
/// and the force on it goes to the grid as that of a contact does: at the node, by the particle's
/// own weights, so that force and moment are kept. The surface is replicated on every rank.
class FreeSurfaceMesh {
 public:
  /// A terrain without a mesh.
  FreeSurfaceMesh() = default;
  /// @param every  particles from node to node along x and y; the last one has a node as well
  FreeSurfaceMesh(const TerrainFill& fill, const Grid& grid, std::size_t every);

  bool exists() const { return !nodes_.empty(); }
  Surface& surface() { return surface_; }
  const Surface& surface() const { return surface_; }

  /// Finds the particles of the nodes among this rank's; needed after particles changed their
  /// order.
  void attach(const std::vector<ParticleGroup>& groups);
  /// Positions and velocities of the nodes from the particles. Collective.
  void update(const std::vector<ParticleGroup>& groups, const Communicator& ranks);
  /// Forces on the nodes, of this rank's particles, become loads of the next step.
  void add_forces_to(PointLoads& loads, const std::vector<ParticleGroup>& groups,
                     const Matrix3X& forces) const;

 private:
  struct NodeAttachment {
    Eigen::Index node;
    ParticleIndex particle;
  };
  /// From the particle to the node [m].
  Vector3 offset(const std::vector<ParticleGroup>& groups, const NodeAttachment& attachment) const;

  /// A node and the number of its particle.
  struct NodeOfParticle {
    double id;
    Eigen::Index node;
  };

  std::vector<NodeOfParticle> nodes_;        // ascending ids
  Matrix3X offset_;                          // of a node from its particle, in half spacings
  std::vector<NodeAttachment> attachments_;  // of this rank's particles
  std::vector<double> motion_;               // position and velocity of each node: 6 numbers
  Surface surface_;
};

}  // namespace furrow
