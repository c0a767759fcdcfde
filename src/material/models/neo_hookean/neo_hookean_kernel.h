// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Kernel of the neo-Hookean law: b_{n+1} = Delta F b_n Delta F^T, stress from b. Equations:
/// neo_hookean.h.

#include "furrow/material/block_update.h"
#include "furrow/material/models/neo_hookean/neo_hookean_parameters.h"
#include "furrow/simd/exponential.h"

namespace furrow {
inline namespace FURROW_ISA {

struct NeoHookeanKernel {
  static constexpr int internal_variables = 6;  // b - I: xx, yy, zz, xy, yz, xz
  const NeoHookeanParameters& parameters;

  /// The new stress in the final frame and the stored energy, from b - I at the start of the step.
  void hyperelastic_step(const Tensor& h, Points<internal_variables>& points) const {
    Lanes* const old = points.internal;
    const Symmetric c{old[0], old[1], old[2], old[3], old[4], old[5]};
    const Symmetric b = c.plus_identity(1.0);
    // b_new - I = c + a + a^T + a H^T with a = H b
    const Lanes columns[9] = {b.xx, b.xy, b.xz, b.xy, b.yy, b.yz, b.xz, b.yz, b.zz};
    Lanes a[9];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        a[3 * i + j] = h.m[3 * i] * columns[j] + h.m[3 * i + 1] * columns[3 + j] +
                       h.m[3 * i + 2] * columns[6 + j];
    const auto change = [&](int i, int j) {
      return a[3 * i + j] + a[3 * j + i] + a[3 * i] * h.m[3 * j] + a[3 * i + 1] * h.m[3 * j + 1] +
             a[3 * i + 2] * h.m[3 * j + 2];
    };
    const Symmetric n = c + Symmetric{change(0, 0), change(1, 1), change(2, 2),
                                      change(0, 1), change(1, 2), change(0, 2)};
    const Lanes trace = n.trace();
    // J^2 - 1 = det(I + n) - 1 without cancellation
    const Lanes excess = trace + Lanes(0.5) * (trace * trace - contract(n, n)) + determinant(n);
    const Lanes log_square =
        per_lane(excess, [](double x) { return __builtin_log1p(x); });  // 2 ln J
    const Lanes J = sqrt(Lanes(1.0) + excess);
    const Lanes isochoric = exponential(log_square * Lanes(-1.0 / 3.0));  // J^(-2/3)
    points.stress = (n.deviator() * (Lanes(parameters.shear) * isochoric / J))
                        .plus_identity(Lanes(0.5 * parameters.bulk) * excess / J);
    points.stored =
        Lanes(0.5 * parameters.shear) * (isochoric * (trace + Lanes(3.0)) - Lanes(3.0)) +
        Lanes(0.25 * parameters.bulk) * (excess - log_square);
    points.internal[0] = n.xx;
    points.internal[1] = n.yy;
    points.internal[2] = n.zz;
    points.internal[3] = n.xy;
    points.internal[4] = n.yz;
    points.internal[5] = n.xz;
  }
};

inline BlockResult update_neo_hookean(const NeoHookeanParameters& parameters, double density,
                                      const PointBlock& block) {
  return update_points(NeoHookeanKernel{parameters}, density, block);
}

constexpr void fill(NeoHookeanKernels& kernels) { kernels.update = update_neo_hookean; }

}  // namespace FURROW_ISA
}  // namespace furrow
