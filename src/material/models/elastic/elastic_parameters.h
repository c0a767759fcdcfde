// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Constants and kernels of the elastic law, as plain data.

#include "furrow/material/elasticity/elasticity_parameters.h"
#include "furrow/material/point_block.h"
#include "furrow/simd/instruction_set.h"

namespace furrow {

struct ElasticParameters {
  ElasticityParameters elasticity;
};

/// Kernels of elastic_kernel.h.
struct ElasticKernels : KernelTable {
  BlockUpdate<ElasticParameters> update = nullptr;

  static const ElasticKernels& baseline();
  static const ElasticKernels& avx2();
  static const ElasticKernels& avx512();
};

}  // namespace furrow
