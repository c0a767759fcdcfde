// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Plain data that the kernels of the shell work on. This header is compiled with every
/// instruction set (simd/lanes.h explains why).

#include <cstddef>

#include "furrow/simd/instruction_set.h"

namespace furrow {

constexpr std::size_t shell4_padding =
    8;  // elements of one shape come in multiples of it: the widest registers hold 8 numbers

/// Elements of one stress-free shape share its stiffness.
struct Shell4Kind {
  /// stiffness in the element's axes; unless the element is mirrored
  double stiffness[24][24];
  /// stiffness for half the sums and half the differences of nodes that are each other's mirror
  /// image (Shell4Mirror), if the element is its own mirror image in the plane of its axes 1 and 3
  double mirror_even[12][12], mirror_odd[12][12];
  bool mirrored = false;
  double x[4][3];  ///< stress-free nodes in the element's axes [m]
  /// inverse of the stress-free medians (columns), rows (p1, p2) and (0, q2) [1/m]; p2 = q2 = 0
  /// where the axes turn with the first median alone
  double p1, p2, q2;
  std::size_t first = 0, last = 0;  ///< range of the places of the elements
};

/// Mirror image in the plane of an element's axes 1 and 3: of node n, and the sign of each of its
/// six displacements and rotations.
struct Shell4Mirror {
  static constexpr int first[2] = {0, 1}, second[2] = {3, 2};
  static constexpr double sign[6] = {1, -1, 1, -1, 1, -1};
};

/// Places of elements, sorted by kind.
struct Shell4Places {
  const int* node[4];
  const double* axes[4];  ///< stress-free element axes in space, as a quaternion x, y, z, w
};

struct Shell4Result {
  double energy = 0.0;  ///< [J]
  double volume = 0.0;  ///< [m^3] a third of the integral of x . n dA
  /// smallest 4 cos^2(angle/2) of a node's rotation relative to its element: 4 without bending, 1
  /// at 120 degrees
  double minimum_four_cos2 = 4.0;
  std::size_t most_rotated = 0;  ///< place of this element
  bool finite = true;
};

/// Kernels of shell4_kernel.h.
struct Shell4Kernels : KernelTable {
  /// Adds what the shell does to its nodes: -dU/dx [N], the moment conjugate to the nodal spin [N
  /// m], and the follower pressure.
  /// @param x      3 numbers a node [m]
  /// @param turn   4 numbers a node, the quaternion x, y, z, w: from the stress-free state
  /// @param on_node 8 numbers a node: force, 0, moment, 0
  Shell4Result (*forces)(const Shell4Kind* kinds, std::size_t kind_count, const Shell4Places&,
                         const double* x, const double* turn, double pressure,
                         double* on_node) = nullptr;

  static const Shell4Kernels& baseline();
  static const Shell4Kernels& avx2();
  static const Shell4Kernels& avx512();
};

}  // namespace furrow
