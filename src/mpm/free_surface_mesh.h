// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The free surface of a terrain as triangles: what grains lie on in a hybrid (theory: hybrid, eqs.
/// 1 to 4).

#include <vector>

#include "furrow/core/communicator.h"
#include "furrow/geometry/surface.h"
#include "furrow/mpm/particles/particle_group.h"
#include "furrow/mpm/transfer/point_loads.h"
#include "furrow/mpm/ground/terrain_fill.h"

namespace furrow {

/// Each node is attached to a particle of the uppermost level, to one in so many, half a spacing
/// (shrunk with the particle's volume) above it; along the edge of the ground it is half a spacing
/// further out as well, on the face of the grid. On the sides of a trough it is half a spacing
/// beside a particle, and in the corners both. It moves with the affine velocity of the particle,
/// and the force on it goes to the grid as that of a contact does: at the node, by the particle's
/// own weights, so that force and moment are kept. The surface is replicated on every rank.
///
/// On ground that moves along, the mesh is made of patches, one for each slab of the ground. When
/// the ground drops a slab behind and adds one ahead, a length further on, that slab's patch goes
/// to the other: in a box whose period is that length its triangles stay where they are, and so do
/// all others. Both patches have nodes where two slabs meet, in one place: the mean of the places
/// by the particles on either side, and forces go to either side in halves.
class FreeSurfaceMesh {
 public:
  /// A terrain without a mesh.
  FreeSurfaceMesh() = default;
  /// @param every  particles from node to node along x and y; the last one, of each slab along x,
  /// has a node as well
  /// @param slabs  patches along x; of ground that stays where it is: 1
  FreeSurfaceMesh(const TerrainFill& fill, const Grid& grid, std::size_t every, std::size_t slabs);

  bool exists() const { return !nodes_.empty(); }
  Surface& surface() { return surface_; }
  const Surface& surface() const { return surface_; }

  /// Places the mesh when the ground has dropped so many slabs since the start; attach() again.
  void place(const TerrainFill& fill, const Grid& grid, std::size_t dropped_slabs);
  /// Finds the particles of the nodes among this rank's; needed after particles changed their
  /// order.
  void attach(const std::vector<ParticleGroup>& groups);
  /// Positions and velocities of the nodes from the motion of the ground at the particles, as a
  /// force on a node sees it. Collective.
  void update(const std::vector<ParticleGroup>& groups, PointLoads& loads,
              const Communicator& ranks);
  /// Forces on the nodes, of this rank's particles, become loads of the next step.
  void add_forces_to(PointLoads& loads, const std::vector<ParticleGroup>& groups,
                     const Matrix3X& forces) const;

 private:
  /// A node in the cross-section of the ground.
  struct SectionNode {
    std::size_t row, level;  // of its particle
    double beside, above;    // of it, in half spacings along y and z
  };
  /// A node, or its share, and the number of its particle.
  struct NodeOfParticle {
    double id;
    Eigen::Index node;
    double share;    // of place, motion and force
    Vector3 offset;  // from the particle, in half spacings
  };
  struct NodeAttachment {
    std::size_t of;  // in nodes_
    ParticleIndex particle;
  };
  static std::vector<SectionNode> nodes_across(const TerrainFill& fill, std::size_t rows,
                                               std::size_t every);
  Eigen::Index node(std::size_t patch, std::size_t column, std::size_t row) const {
    return static_cast<Eigen::Index>((patch * along_.size() + column) * across_.size() + row);
  }
  void add_triangles(std::size_t patch);
  /// Vector from the particle to the node [m].
  Vector3 offset(const std::vector<ParticleGroup>& groups, const NodeAttachment& attachment) const;

  std::size_t slabs_ = 0, columns_of_slab_ = 0;  // columns of particles
  std::vector<std::size_t> along_;               // columns of a slab with nodes
  std::vector<SectionNode> across_;
  std::vector<NodeOfParticle> nodes_;        // ascending ids
  std::vector<NodeAttachment> attachments_;  // of this rank's particles
  std::vector<double> motion_;               // position and velocity of each node: 6 numbers
  // Particles of the attachments and their motions.
  std::vector<ParticleIndex> particles_;
  std::vector<ParticleMotion> particle_motions_;
  Surface surface_;
};

}  // namespace furrow
