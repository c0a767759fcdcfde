// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Input of the kernel of the nodes' step, as plain data: this header is compiled with every
/// instruction set (simd/lanes.h explains why).

#include <cstddef>

#include "furrow/simd/instruction_set.h"

namespace furrow {

constexpr std::size_t node_step_padding = 8;  // numbers in the widest registers

/// Nodes with the forces on them, node by node.
struct NodeStepNodes {
  std::size_t count;
  double *x, *v, *w;               ///< 3 a node [m], [m/s], [rad/s]
  double* turn;                    ///< 4, the quaternion x, y, z, w
  const double *force, *moment;    ///< 3, of elements and pressure [N], [N m]
  const double* contact;           ///< 3 components of the contact force [N]
  const double *mass, *inertia;    ///< 1, padded [kg], [kg m^2]
  const double* mobility[3];       ///< 1, padded: of each component 1/mass, or 0 where it is held
  const double* spin_mobility[3];  ///< 1/inertia, or 0
};

/// The rigid motion that the damping refers to.
struct NodeStepRim {
  double centre[3];    ///< [m]
  double velocity[3];  ///< [m/s]
  double spin[3];      ///< [rad/s]
};

/// Sums over all nodes; moments are about the rim's centre.
struct NodeStepSums {
  double force[3], moment[3];                  ///< of elements and pressure [N], [N m]
  double damping_force[3], damping_moment[3];  ///< [N], [N m]
  double contact_power;                        ///< by the mean velocities of the step [W]
  double damping_power;                        ///< [W]
  bool finite;                                 ///< places afterwards
};

/// Kernels of node_step_kernel.h.
struct NodeStepKernels : KernelTable {
  /// @param rate of the damping [1/s]
  NodeStepSums (*step)(const NodeStepNodes&, const NodeStepRim&, double rate, double dt) = nullptr;

  static const NodeStepKernels& baseline();
  static const NodeStepKernels& avx2();
  static const NodeStepKernels& avx512();
};

}  // namespace furrow
