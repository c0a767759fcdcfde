// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Particles to grid and back: the affine particle-in-cell transfer, the force of the stress and
/// the strain. Plain data only: this header is compiled with every instruction set
/// (simd/lanes.h says why that matters).
///
/// With N_i the B-splines of a particle's 27 nodes, d_i = x_i - x_p and D = sum N_i d_i d_i^T
/// (diagonal for a product grid):
///   momentum to the grid   m_i = sum_p N_i m,   m_i v_i = sum_p N_i m (v + C d_i)
///   motion from the grid   v = sum N_i v_i,     C = (sum N_i v_i d_i^T) D^-1
///   force to the grid      f_i = -sum_p V sigma G_i
///   strain from the grid   H = dt sum v_i G_i^T
/// Linear momentum is kept because sum N_i = 1, angular momentum because C carries it (C. Jiang, C.
/// Schroeder, J. Teran, J. Comput. Phys. 338, 2017). Force and strain have the same G_i, so that
/// the work of the stress is what the grid loses. G_i = N_i D^-1 d_i (Y. Hu et al., ACM Trans.
/// Graph. 37, 2018): among equal cells it sums up to the integral of grad N_i over a cell, so that
/// a uniform stress leaves the nodes inside at rest. In cells that end the axis or have neighbours
/// of other lengths ("uneven") it does not, by up to 40 % of the stress: there, in those
/// directions, G_i = grad N_i.
///
/// All weights are taken at a particle's reference position, which stays while the grid moves with
/// the ground (continuum_terrain.h).

#include <cstddef>

#include "mpm/axis.h"
#include "simd/instruction_set.h"

namespace furrow {

constexpr std::size_t stencil = 3;  ///< nodes of a particle in each direction
/// particles whose weights are found together: they fit the first cache
constexpr std::size_t batch = 64;

/// Splines of a batch of particles, direction by direction.
struct Weights {
  double value[3][stencil][batch];
  /// G of each direction for force and strain, N d for momentum and motion
  double slope[3][stencil][batch];
  double inverse_spread[3][batch];  ///< 1/D; with N d only
  int first[batch];                 ///< node of the lowest corner
};
constexpr std::size_t batches(std::size_t particles) { return (particles + batch - 1) / batch; }

/// The grid as a kernel sees it: four numbers a node, aligned to 32 bytes; z runs fastest, then y,
/// then x.
struct GridView {
  AxisView axis[3];
  double* sums;                ///< momentum [N s] and mass [kg], or force [N] and zero
  const double* velocity;      ///< [m/s], and mass
  const double* displacement;  ///< [m] since particles were last moved; the fourth is unused
};

/// Some neighbouring particles of one material.
struct ParticleView {
  std::size_t size = 0;
  const double* reference[3] = {};  ///< position of the weights [m]
  double* position[3] = {};         ///< [m]
  double* velocity = nullptr;       ///< [m/s] four numbers a particle, the last is unused
  /// C [1/s] column by column, four numbers each, the last is unused
  double* affine = nullptr;
  const double* volume = nullptr;        ///< in the reference configuration [m^3]
  const double* volume_ratio = nullptr;  ///< J
  const double* stress[6] = {};          ///< xx, yy, zz, xy, yz, xz [Pa]
};

/// A force at a point near a particle: given to the particle's nodes with force and moment kept.
struct PointForce {
  double position[3];  ///< reference position of the particle [m]
  double force[3];     ///< [N]
  double lever[3];     ///< from there to the point where the force acts [m]
};

/// What the grid says of one particle.
struct PointMotion {
  double position[3];      ///< reference position, given by the caller [m]
  double displacement[4];  ///< since particles were last moved [m]
  double velocity[4];      ///< [m/s]
  double affine[12];       ///< C [1/s], three columns of four numbers
};

/// Kernels of transfer_kernel.h.
struct TransferKernels : KernelTable {
  /// @return number of particles outside of the grid, or no number; nothing is added for their
  /// batch. The others expect none.
  std::size_t (*scatter_momentum)(const GridView&, const ParticleView&, double density) = nullptr;
  void (*scatter_point_forces)(const GridView&, const PointForce*, std::size_t count) = nullptr;
  /// With G, for the two that follow. @param weights batches(size) of them
  void (*find_weights)(const GridView&, const ParticleView&, Weights* weights) = nullptr;
  void (*scatter_force)(const GridView&, const ParticleView&, const Weights*) = nullptr;
  /// @param gradient nine arrays for H, row by row (PointBlock)
  void (*gather_strain)(const GridView&, const ParticleView&, const Weights*, double dt,
                        double* const* gradient) = nullptr;
  /// V sigma : H of the particles with their present stress [J]
  double (*stress_work)(const ParticleView&, const double* const* gradient) = nullptr;
  /// Moves the particles by the nodes' displacement and gives them the nodes' velocity.
  void (*gather_motion)(const GridView&, const ParticleView&) = nullptr;
  void (*probe)(const GridView&, PointMotion*, std::size_t count) = nullptr;

  static const TransferKernels& baseline();
  static const TransferKernels& avx2();
  static const TransferKernels& avx512();
};

/// Those of this run (simd/dispatch.h).
const TransferKernels& transfer_kernels();

}  // namespace furrow
