// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The table of kernels of one instruction set; included once by each kernels_*.cpp.

#include "material/models/crushable_foam/crushable_foam_kernel.h"
#include "material/models/drucker_prager_cap/drucker_prager_cap_kernel.h"
#include "material/models/elastic/elastic_kernel.h"
#include "material/models/neo_hookean/neo_hookean_kernel.h"

namespace furrow {
inline namespace FURROW_ISA {

inline BlockResult update_crushable_foam(const CrushableFoamParameters& parameters, double density,
                                         const PointBlock& block) {
  if (parameters.flow_ratio < 1.0)
    return update_points(CrushableFoamKernel<true>{parameters}, density, block);
  return update_points(CrushableFoamKernel<false>{parameters}, density, block);
}
inline BlockResult update_drucker_prager_cap(const DruckerPragerCapParameters& parameters,
                                             double density, const PointBlock& block) {
  if (parameters.flow_ratio < 1.0)
    return update_points(DruckerPragerCapKernel<true>{parameters}, density, block);
  return update_gathered(DruckerPragerCapKernel<false>{parameters}, density, block);
}
inline BlockResult update_elastic(const ElasticityParameters& elasticity, double density,
                                  const PointBlock& block) {
  return update_points(ElasticKernel{elasticity}, density, block);
}
inline BlockResult update_neo_hookean(const NeoHookeanParameters& parameters, double density,
                                      const PointBlock& block) {
  return update_points(NeoHookeanKernel{parameters}, density, block);
}

constexpr Kernels all_kernels(const char* instruction_set) {
  return {instruction_set,           lane_count,     update_crushable_foam,
          update_drucker_prager_cap, update_elastic, update_neo_hookean};
}

}  // namespace FURROW_ISA
}  // namespace furrow
