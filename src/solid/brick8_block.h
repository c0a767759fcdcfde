// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Data of a kernel of the brick works on, as plain data: this header is compiled with every
/// instruction set (simd/lanes.h explains why).

#include <cstddef>

#include "furrow/simd/instruction_set.h"

namespace furrow {

constexpr std::size_t brick8_padding =
    8;  // elements of one shape come in multiples of it: the widest registers hold 8 numbers

/// Elements of one stress-free shape and rubber. Gradients are those of the nodes' shape functions
/// in the element's axes. The energy of an isotropic material does not depend on the axes, so the
/// orientation of the element is not needed.
struct Brick8Kind {
  double gradient[8][8][3];        ///< [1/m] at a Gauss point, of a node
  double mean_gradient[8][3];      ///< [1/m] mean over the volume
  double weight[8];                ///< [m^3] of the Gauss points
  double volume;                   ///< V0 [m^3]
  double shear, bulk;              ///< mu, K [Pa]
  double inverse_mass[8];          ///< [1/kg] of the shares that the nodes bring into the element
  double deviatoric_rate;          ///< highest omega^2 by mu alone, stress-free [1/s^2]
  double highest_rate;             ///< highest omega^2, stress-free [1/s^2]
  std::size_t first = 0, end = 0;  ///< padded range of the places of the elements
};

/// Places of elements, sorted by kind; one that only pads has the nodes of another and active = 0.
struct Brick8Places {
  const int* node[8];
  const unsigned char* active;
};

struct Brick8Result {
  double energy = 0.0;            ///< [J]
  double minimum_ratio = 1e30;    ///< smallest det F at a Gauss point
  std::size_t most_squeezed = 0;  ///< place of this element
  double highest_rate = 0.0;      ///< estimate of the largest omega^2 of an element now [1/s^2]
  bool finite = true;
};

/// Kernels of brick8_kernel.h.
struct Brick8Kernels : KernelTable {
  /// Adds -dW/dx [N] to the nodes. @param x 3 numbers a node [m]
  Brick8Result (*forces)(const Brick8Kind* kinds, std::size_t kind_count, const Brick8Places&,
                         const double* x, double* force) = nullptr;

  static const Brick8Kernels& baseline();
  static const Brick8Kernels& avx2();
  static const Brick8Kernels& avx512();
};

}  // namespace furrow
