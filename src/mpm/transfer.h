#pragma once
/// Particles to grid and back: the affine particle-in-cell transfer and the force of the stress. Plain data only: this header is compiled
/// with every instruction set (material/lanes.h says why that matters).
///
/// With N_i the B-splines of a particle's 27 nodes, d_i = x_i - x_p and D = sum N_i d_i d_i^T (diagonal for a product grid):
///   to the grid    m_i = sum_p N_i m,   m_i v_i = sum_p N_i [ m (v + C d_i) + dt (m g - V sigma D^-1 d_i) ]
///   from the grid  v = sum N_i v_i,     C = (sum N_i v_i d_i^T) D^-1
/// C is both the affine velocity and the velocity gradient that the law sees: force and strain are adjoint, so the work of the stress
/// is what the grid loses. Linear momentum is kept because sum N_i = 1, angular momentum because C carries it
/// (C. Jiang, C. Schroeder, J. Teran, J. Comput. Phys. 338, 2017; force as Y. Hu et al., ACM Trans. Graph. 37, 2018).
///
/// Among equal cells N_i D^-1 d_i sums up to the integral of grad N_i over a cell, so that a uniform stress leaves the nodes inside at
/// rest. In cells that end the axis or have neighbours of other lengths ("uneven") it does not, by up to 40 % of the stress: there force
/// and velocity gradient take grad N_i instead of N_i D^-1 d_i, in the uneven directions; C remains what carries momentum.

#include <cstddef>

#include "mpm/axis.h"

namespace furrow {

constexpr std::size_t stencil = 3;  ///< nodes of a particle in each direction

/// The grid as a kernel sees it: four numbers a node, momentum (or velocity) and mass; z runs fastest, then y, then x.
struct GridView {
  AxisView axis[3];
  double* node;  ///< aligned to 32 bytes
};

/// Some neighbouring particles of one material.
struct ParticleView {
  std::size_t size = 0;
  double* position[3] = {};              ///< [m]
  double* velocity = nullptr;            ///< [m/s] four numbers a particle, the last is unused
  double* affine = nullptr;              ///< C [1/s] column by column, four numbers each, the last is unused
  const double* volume = nullptr;        ///< in the reference configuration [m^3]
  const double* volume_ratio = nullptr;  ///< J
  const double* stress[6] = {};          ///< xx, yy, zz, xy, yz, xz [Pa]
};

/// What gather() sums over its particles, and the first that cannot be placed.
struct TransferSums {
  double kinetic_energy = 0.0;  ///< of the particles after the step, affine part included [J]
  double stress_work = 0.0;     ///< done on the material: dt V sigma : C, with the stress of the start of the step [J]
  double momentum[3] = {};      ///< [kg m/s]
  double largest_speed = 0.0;   ///< [m/s] a bound: of the largest components
  std::size_t outside = 0;      ///< particles that are not inside the grid, or are no number
  std::size_t first_outside = 0;
};

/// An impulse at a point near a particle: given to the particle's nodes with force and moment kept.
struct PointImpulse {
  double position[3];  ///< of the particle [m]
  double impulse[3];   ///< [N s]
  double lever[3];     ///< from the particle to the point where the force acts [m]
};

struct TransferKernels {
  const char* instruction_set;
  /// @return number of particles outside of the grid; nothing is added for their batch
  std::size_t (*scatter)(const GridView&, const ParticleView&, double density, double dt, const double* gravity);
  void (*scatter_impulses)(const GridView&, const PointImpulse*, std::size_t count);
  /// Moves the particles; @param gradient nine arrays for dt C, row by row (PointBlock)
  TransferSums (*gather)(const GridView&, const ParticleView&, double density, double dt, double* const* gradient);
};

const TransferKernels& transfer_kernels_baseline();
const TransferKernels& transfer_kernels_avx2();  // x86 builds only
const TransferKernels& transfer_kernels_avx512();
/// Those of an instruction set that available_kernels() names (material/kernels.h).
const TransferKernels& transfer_kernels(const char* instruction_set);
/// Those of the instruction set that the laws use.
const TransferKernels& transfer_kernels();

}  // namespace furrow
