// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Data of the kernel of pointwise laws (pointwise_material.h), as plain data.

#include <cstddef>

#include "furrow/material/point_block.h"
#include "furrow/simd/instruction_set.h"

namespace furrow {

constexpr int max_pointwise_variables = 48;  ///< internal variables of one law, in numbers

/// One point in a step. Tensors: xx, yy, zz, xy, yz, xz.
struct PointwiseNumbers {
  double strain[6];  ///< ln U of the step
  /// State from here on: at the start of the step, to be replaced by that at its end, before the
  /// rotation.
  double stress[6];  ///< [Pa]
  double internal[max_pointwise_variables];
  double stored;  ///< energies of the step per current volume [J/m^3]
  double frozen;
  double dissipated;
  double branch;  ///< a Branch
  double iterations;
  bool below_data;  ///< outside the data of the hardening
  bool beyond_data;
};

struct PointwiseParameters {
  const void* context;  ///< for `step`
  /// Takes one step of one point of a block. May throw: kernels hold nothing that would be lost.
  void (*step)(const void* context, std::size_t point, PointwiseNumbers& numbers);
  int internal_variables;  ///< in numbers
  const int* tensors;      ///< the first number of each internal tensor
  int tensor_count;
};

/// Kernels of pointwise_kernel.h.
struct PointwiseKernels : KernelTable {
  BlockUpdate<PointwiseParameters> update = nullptr;

  static const PointwiseKernels& baseline();
  static const PointwiseKernels& avx2();
  static const PointwiseKernels& avx512();
};

}  // namespace furrow
