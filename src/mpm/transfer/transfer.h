// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Particles to grid and back: the affine particle-in-cell transfer (APIC), the force of the stress
/// and the strain (theory: continuum, eqs. 2 to 4). Plain data only: this header is compiled with
/// every instruction set (simd/lanes.h explains why that matters); the kernels are in transfer/.
///
/// With N_i the quadratic B-splines of a particle's 27 nodes, d_i = x_i - x_p and
/// D = sum N_i d_i d_i^T (diagonal for a product grid):
///   scatter_momentum   m_i = sum_p N_i m,   m_i v_i = sum_p N_i m (v + C d_i)
///   gather_residual    r = v - sum N_i v_i, w = the spin of C - (sum N_i v_i d_i^T) D^-1
///   gather_motion      v = sum N_i v_i + a r,   C = (sum N_i v_i d_i^T) D^-1 + a [w]x
///   scatter_force      f_i = -sum_p V sigma G_i
///   gather_strain      H = dt sum v_i G_i^T
/// Linear momentum is conserved because sum N_i = 1, angular momentum because C carries it
/// [Jiang2017]. The residual motion r, w has neither: what r has of angular momentum, w takes back.
/// Therefore any share a of it may be kept [Fei2021]. Force and strain have the same G_i, so the
/// work of the stress is what the grid loses. G_i = N_i D^-1 d_i [Hu2018] sums to the integral of
/// grad N_i over a cell if all cells have one length, so a uniform stress leaves the inner nodes at
/// rest. In cells at the end of an axis or next to cells of another length the error would reach 40
/// % of the stress; there, in those directions, G_i = grad N_i.
///
/// All weights are those at a particle's quadrature position, which stays while the grid moves with
/// the ground (terrain_step.h).

#include <cstddef>

#include "furrow/mpm/grid/axis.h"
#include "furrow/simd/instruction_set.h"

namespace furrow {

constexpr std::size_t stencil = 3;  ///< nodes of a particle in each direction
/// particles per batch of weights: they fit the first cache
constexpr std::size_t batch = 64;

/// Splines of a batch of particles, axis by axis; those of a node are products over the axes.
struct Weights {
  double value[3][stencil][batch];  ///< N
  /// the second factor along each axis: G for force and strain, N d for momentum and motion
  double slope[3][stencil][batch];
  double inverse_spread[3][batch];  ///< 1/D; with N d only
  int first_node[batch];            ///< in memory, the node at the lowest corner
};
constexpr std::size_t batches(std::size_t particles) { return (particles + batch - 1) / batch; }

/// The grid as a kernel sees it: four numbers for each node, aligned to 32 bytes; z runs fastest,
/// then y, then x. Columns of nodes along z are in memory for a rectangle along x and y.
struct GridView {
  AxisView axis[3];
  int first_column[2];         ///< the lowest of these along x and y
  int columns_along_y;         ///< number of columns along y
  double* sums;                ///< momentum [N s] and mass [kg], or force [N] and zero
  const double* velocity;      ///< [m/s], and mass
  const double* displacement;  ///< since particles were last moved [m]; the fourth is unused
};

/// Some neighbouring particles of one material.
struct ParticleView {
  std::size_t size = 0;
  const double* quadrature_position[3] = {};  ///< quadrature position of the weights [m]
  double* position[3] = {};                   ///< [m]
  double* velocity = nullptr;  ///< four numbers for each particle, the last is unused [m/s]
  /// C column by column: 3 x 4 numbers for each particle, the fourth of a column is zero [1/s]
  double* affine = nullptr;
  double* residual = nullptr;      ///< r and w of gather_residual(), four numbers each [m/s, 1/s]
  const double* cell = nullptr;    ///< equal for the particles of a cell, which follow one another
  const double* volume = nullptr;  ///< in the reference configuration [m^3]
  const double* volume_ratio = nullptr;  ///< J
  const double* stress[6] = {};          ///< xx, yy, zz, xy, yz, xz [Pa]
};

/// A force at a point near a particle: goes to the particle's nodes with force and moment kept.
struct PointForce {
  double quadrature_position[3];  ///< of the particle [m]
  double force[3];                ///< [N]
  double arm[3];                  ///< from there to the point where the force acts [m]
};

/// Motion of the grid at a particle.
struct PointMotion {
  double quadrature_position[3];  ///< of the particle, given by the caller [m]
  double displacement[4];         ///< since particles were last moved [m]
  double velocity[4];             ///< [m/s]
  double affine[12];              ///< C, three columns of four numbers [1/s]
};

/// Work of the stress in a displacement gradient H [J].
struct StressWork {
  double total = 0.0;     ///< sum V sigma : H
  double vertical = 0.0;  ///< sum V sigma_zz H_zz, the whole power in confined compression
};

/// Kernels of transfer_kernel.h.
struct TransferKernels : KernelTable {
  /// Weights with slope G, for scatter_force and gather_strain.
  /// @param weights  an array of batches(size)
  void (*find_weights)(const GridView&, const ParticleView&, Weights* weights) = nullptr;

  // Particles to grid; each adds to the sums of the nodes.

  /// @return how many particles are outside of the grid (a position that is not a number counts);
  /// nothing is added for their batch. The other kernels expect that there are none.
  std::size_t (*scatter_momentum)(const GridView&, const ParticleView&, double density) = nullptr;
  void (*scatter_force)(const GridView&, const ParticleView&, const Weights*) = nullptr;
  void (*scatter_point_forces)(const GridView&, const PointForce*, std::size_t count) = nullptr;

  // Grid to particles.

  /// @param gradient  nine arrays for H, row by row (PointBlock)
  void (*gather_strain)(const GridView&, const ParticleView&, const Weights*, double dt,
                        double* const* gradient) = nullptr;
  /// Work of the present stress of the particles in a step.
  StressWork (*stress_work)(const ParticleView&, const double* const* gradient) = nullptr;
  /// Gathers the part of the particles' motion that a fresh grid does not take.
  void (*gather_residual)(const GridView&, const ParticleView&) = nullptr;
  /// Moves the particles by the nodes' displacement and takes the nodes' velocity, with a share of
  /// the residual motion.
  void (*gather_motion)(const GridView&, const ParticleView&, double share) = nullptr;
  void (*interpolate_motion)(const GridView&, PointMotion*, std::size_t count) = nullptr;

  static const TransferKernels& baseline();
  static const TransferKernels& avx2();
  static const TransferKernels& avx512();
};

/// Kernels for the processor of this run (simd/dispatch.h).
const TransferKernels& transfer_kernels();

}  // namespace furrow
