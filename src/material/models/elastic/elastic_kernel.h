// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Kernel of the elastic law.

#include "furrow/material/block_update.h"
#include "furrow/material/elasticity/elasticity_kernel.h"
#include "furrow/material/models/elastic/elastic_parameters.h"

namespace furrow {
inline namespace FURROW_ISA {

struct ElasticKernel {
  static constexpr int internal_variables = 0;
  const ElasticParameters& parameters;

  FURROW_INLINE void step(const Symmetric& strain, Points<0>& points) const {
    const ElasticStep elastic(parameters.elasticity, points.stress.trace() * Lanes(-1.0 / 3.0));
    const Lanes x = -strain.trace();
    const Lanes p = elastic.pressure(x);
    const Symmetric change = strain.deviator() * (Lanes(2.0) * elastic.shear);
    const Symmetric s = points.stress.plus_identity(elastic.p_n) + change;
    points.stored =
        elastic.volumetric_work(x, p) + contract(s - change * Lanes(0.5), strain.deviator());
    points.stress = s.plus_identity(-p);
  }
};

inline BlockResult update_elastic(const ElasticParameters& parameters, double density,
                                  const PointBlock& block) {
  return update_points(ElasticKernel{parameters}, density, block);
}

constexpr void fill(ElasticKernels& kernels) { kernels.update = update_elastic; }

}  // namespace FURROW_ISA
}  // namespace furrow
