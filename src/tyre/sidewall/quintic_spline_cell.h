// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Data of a kernel of the spline works on, as plain data: this header is compiled with every
/// instruction set (simd/lanes.h explains why).

#include <cstddef>

#include "furrow/simd/instruction_set.h"

namespace furrow {

/// A cell of the grid, and a point in it.
struct QuinticSplineCell {
  /// coefficients of its 6 x 6 x 6 B-splines, those along axis 2 next to each other
  const double* corner;
  std::ptrdiff_t stride0, stride1;  ///< of the coefficients
  double inside[3];                 ///< 0 to 1 in steps of the grid
  double per_step[3];               ///< 1/step
};

struct QuinticSplineResult {
  double f;
  double gradient[3];
  double hessian[6];  ///< 00, 11, 22, 01, 02, 12
};

/// Kernels of quintic_spline_kernel.h.
struct QuinticSplineKernels : KernelTable {
  /// Value and gradient.
  void (*gradient)(const QuinticSplineCell&, QuinticSplineResult&) = nullptr;
  /// Value, gradient and second derivatives.
  void (*hessian)(const QuinticSplineCell&, QuinticSplineResult&) = nullptr;

  static const QuinticSplineKernels& baseline();
  static const QuinticSplineKernels& avx2();
  static const QuinticSplineKernels& avx512();
};

}  // namespace furrow
