#pragma once
/// The table of kernels of one instruction set; included once by each kernels_*.cpp.

#include "material/elastic_kernel.h"

namespace furrow {
inline namespace FURROW_ISA {

inline BlockResult update_elastic(const ElasticityParameters& elasticity, double density, const PointBlock& block) {
  return update_points(ElasticKernel{elasticity}, density, block);
}

constexpr Kernels all_kernels(const char* instruction_set) {
  return {instruction_set, lane_count, update_elastic};
}

}  // namespace FURROW_ISA
}  // namespace furrow
