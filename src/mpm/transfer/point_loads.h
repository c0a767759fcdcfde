// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Forces at points of the ground and its motion there: what a contact exchanges with a terrain.

#include <vector>

#include "furrow/core/types.h"
#include "furrow/mpm/grid/discretisation.h"
#include "furrow/mpm/transfer/remap_control.h"
#include "furrow/mpm/terrain_energy.h"
#include "furrow/mpm/transfer/transfer.h"

namespace furrow {

/// Motion of the ground around a particle: v(x) = velocity + affine (x - quadrature_position).
struct ParticleMotion {
  Vector3 position;             ///< now [m]
  Vector3 quadrature_position;  ///< quadrature position of the velocity [m]
  Vector3 velocity;             ///< [m/s]
  Matrix3 affine;               ///< C [1/s]
  Vector3 velocity_at(const Vector3& x) const {
    return velocity + affine * (x - quadrature_position);
  }
};

/// Each rank adds and asks for its own particles; no call is collective.
class PointLoads {
 public:
  PointLoads(Discretisation& discretisation, RemapControl& remap);

  /// A force on the ground during the next step [N], through the weights of a particle near the
  /// point where it acts [m]. @param work  of whoever presses: gets the work of the force [J] when
  /// the step is taken, and must live until then; none: nobody asks for it
  void add(const ParticleIndex& near, const Vector3& force, const Vector3& point,
           double* work = nullptr);

  Vector3 total_force() const;  ///< of the forces added for the next step [N]

  /// Adds the forces to the sums of the nodes; force and moment are kept.
  void scatter_to_grid();
  /// The work of the forces over a step of dt [s] that the nodes have taken; the forces are
  /// removed.
  void count_work(double dt, TerrainEnergy& energy);

  /// Positions and motions of the ground at particles now, as the grid has it: without the residual
  /// motion, on which forces do no work.
  void interpolate_motion(const std::vector<ParticleIndex>& particles,
                          std::vector<ParticleMotion>& motions);

 private:
  struct PointLoad {
    ParticleIndex near;
    Vector3 force;
    Vector3 point;
    double* work;
  };
  const Particles& particles_of(const ParticleIndex& index) const {
    return discretisation_.groups[index.group].particles;
  }
  std::size_t field_of(const ParticleIndex& index) const {
    return static_cast<std::size_t>(discretisation_.groups[index.group].field);
  }

  Discretisation& discretisation_;
  RemapControl& remap_;
  const TransferKernels& kernels_;
  std::vector<PointLoad> loads_;
  // Buffers of a step; forces and motions by velocity field.
  std::vector<std::vector<PointForce>> forces_;
  std::vector<std::vector<PointMotion>> grid_motions_;
  std::vector<ParticleIndex> loaded_;
  std::vector<ParticleMotion> loaded_motions_;
};

}  // namespace furrow
