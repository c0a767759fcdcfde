// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A quintic spline of three variables at a point: the six B-splines along axis 2, and the six
/// coefficients of a row, lie in the lanes.

#include "furrow/simd/lanes.h"
#include "furrow/tyre/sidewall/quintic_spline_cell.h"

namespace furrow {
inline namespace FURROW_ISA {

constexpr int spline_order = 6;  // B-splines that are not zero in a cell
constexpr int spline_blocks = (spline_order + lane_count - 1) / lane_count;
constexpr int spline_padded = spline_blocks * lane_count;

/// Six numbers; lanes beyond are 0.
struct SplineRow {
  Lanes part[spline_blocks];

  FURROW_INLINE SplineRow() {
    for (Lanes& p : part) p = 0.0;
  }
  FURROW_INLINE explicit SplineRow(const double* numbers) {
    for (int k = 0; k < spline_blocks; ++k) {
      const int left = spline_order - k * lane_count;
      const double* from = numbers + k * lane_count;
      part[k] = left >= lane_count ? Lanes::load(from) : Lanes::load_some(from, left);
    }
  }
  FURROW_INLINE void add(double factor, const SplineRow& other) {
    for (int k = 0; k < spline_blocks; ++k) part[k] += factor * other.part[k];
  }
  FURROW_INLINE double dot(const SplineRow& other) const {
    Lanes products = part[0] * other.part[0];
    for (int k = 1; k < spline_blocks; ++k) products += part[k] * other.part[k];
    return sum(products);
  }
};

/// 120 times the polynomials of the six B-splines in a cell, by the power of x.
constexpr double spline_powers[6][spline_order] = {
    {1, 26, 66, 26, 1, 0},    {-5, -50, 0, 50, 5, 0},  {10, 20, -60, 20, 10, 0},
    {-10, 20, 0, -20, 10, 0}, {5, -20, 30, -20, 5, 0}, {-1, 5, -10, 10, -5, 1}};

/// The six B-splines with their first derivatives, or two, at 0 <= x <= 1 in steps.
template <int derivatives>
struct SplineBasis {
  SplineRow row[derivatives + 1];
  double number[derivatives + 1][spline_padded];

  FURROW_INLINE SplineBasis(double x, double per_step) {
    double scale = 1.0 / 120.0;
    for (int derivative = 0; derivative <= derivatives; ++derivative, scale *= per_step) {
      SplineRow sum;
      for (int n = 5; n >= derivative; --n) {
        double factor = scale;  // factor of x^n after differentiation
        for (int k = 0; k < derivative; ++k) factor *= n - k;
        const SplineRow power(spline_powers[n]);
        for (int k = 0; k < spline_blocks; ++k)
          sum.part[k] = sum.part[k] * x + factor * power.part[k];
      }
      row[derivative] = sum;
      for (int k = 0; k < spline_blocks; ++k)
        sum.part[k].store(number[derivative] + k * lane_count);
    }
  }
};

/// Sums along axis 1, then 0, in rows of coefficients along axis 2; in names of rows the
/// derivatives along axes 0 and 1.
template <bool with_hessian>
FURROW_INLINE void evaluate_spline(const QuinticSplineCell& cell, QuinticSplineResult& result) {
  using Basis = SplineBasis<with_hessian ? 2 : 1>;
  const Basis b0(cell.inside[0], cell.per_step[0]), b1(cell.inside[1], cell.per_step[1]),
      b2(cell.inside[2], cell.per_step[2]);
  SplineRow s00, s10, s01, s20, s11, s02;
  for (int i = 0; i < spline_order; ++i) {
    SplineRow r0, r1, r2;
    for (int j = 0; j < spline_order; ++j) {
      const SplineRow row(cell.corner + i * cell.stride0 + j * cell.stride1);
      r0.add(b1.number[0][j], row);
      r1.add(b1.number[1][j], row);
      if constexpr (with_hessian) r2.add(b1.number[2][j], row);
    }
    s00.add(b0.number[0][i], r0);
    s10.add(b0.number[1][i], r0);
    s01.add(b0.number[0][i], r1);
    if constexpr (with_hessian) {
      s20.add(b0.number[2][i], r0);
      s11.add(b0.number[1][i], r1);
      s02.add(b0.number[0][i], r2);
    }
  }
  const SplineRow &b = b2.row[0], &d = b2.row[1];
  result.f = b.dot(s00);
  result.gradient[0] = b.dot(s10);
  result.gradient[1] = b.dot(s01);
  result.gradient[2] = d.dot(s00);
  if constexpr (with_hessian) {
    result.hessian[0] = b.dot(s20);
    result.hessian[1] = b.dot(s02);
    result.hessian[2] = b2.row[2].dot(s00);
    result.hessian[3] = b.dot(s11);
    result.hessian[4] = d.dot(s10);
    result.hessian[5] = d.dot(s01);
  }
}

inline void spline_gradient(const QuinticSplineCell& cell, QuinticSplineResult& result) {
  evaluate_spline<false>(cell, result);
}
inline void spline_hessian(const QuinticSplineCell& cell, QuinticSplineResult& result) {
  evaluate_spline<true>(cell, result);
}

constexpr void fill(QuinticSplineKernels& kernels) {
  kernels.gradient = spline_gradient;
  kernels.hessian = spline_hessian;
}

}  // namespace FURROW_ISA
}  // namespace furrow
