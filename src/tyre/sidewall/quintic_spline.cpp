// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/sidewall/quintic_spline.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/simd/dispatch.h"
#include "furrow/tyre/sidewall/quintic_spline_cell.h"

namespace furrow {

namespace {

/// Coefficients from values along one axis: B-spline values 1, 26, 66, 26, 1 over 120 at a node;
/// the sixth difference of the coefficients is the jump of the fifth derivative at a node.
Eigen::PartialPivLU<Eigen::MatrixXd> collocation(int nodes) {
  const int n = nodes + 4;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < nodes; ++i)
    for (int k = 0; k < 5; ++k)
      matrix(i, i + k) = std::array<double, 5>{1.0, 26.0, 66.0, 26.0, 1.0}[std::size_t(k)] / 120.0;
  int row = nodes;
  for (const int node : {1, 2, nodes - 3, nodes - 2}) {
    for (int k = 0; k < 7; ++k)
      matrix(row, node - 1 + k) =
          std::array<double, 7>{1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0}[std::size_t(k)] / 20.0;
    ++row;
  }
  return matrix.lu();
}

}  // namespace

QuinticSpline3 QuinticSpline3::of(const std::array<GridAxis, 3>& axes,
                                  std::vector<double> coefficients) {
  QuinticSpline3 spline;
  std::size_t count = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    if (axes[k].nodes < 6 || !(axes[k].upper > axes[k].lower))
      throw StateError(
          fmt::format("spline: axis {} has {} nodes from {} to {}; it needs 6 at least, increasing",
                      k + 1, axes[k].nodes, axes[k].lower, axes[k].upper));
    spline.per_step_[k] = 1.0 / axes[k].step();
    count *= static_cast<std::size_t>(axes[k].nodes + 4);
  }
  if (coefficients.size() != count)
    throw StateError(
        fmt::format("spline: {} coefficients instead of {}", coefficients.size(), count));
  spline.axes_ = axes;
  spline.stride_ = {(axes[1].nodes + 4) * (axes[2].nodes + 4), axes[2].nodes + 4, 1};
  spline.coefficients_ = std::move(coefficients);
  return spline;
}

QuinticSpline3 QuinticSpline3::through(const std::array<GridAxis, 3>& axes,
                                       const std::vector<double>& values) {
  const int n[3] = {axes[0].nodes, axes[1].nodes, axes[2].nodes},
            m[3] = {n[0] + 4, n[1] + 4, n[2] + 4};
  const auto size = [](int a, int b, int c) {
    return static_cast<std::size_t>(a) * std::size_t(b) * std::size_t(c);
  };
  std::vector<double> coefficients(size(m[0], m[1], m[2]), 0.0);
  const QuinticSpline3 shape = of(axes, coefficients);  // checks the axes
  if (values.size() != size(n[0], n[1], n[2]) ||
      !std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }))
    throw StateError(fmt::format("spline: needs {} finite values", size(n[0], n[1], n[2])));
  const auto at = [&](int i, int j, int k) -> double& {
    return coefficients[static_cast<std::size_t>(i * shape.stride_[0] + j * shape.stride_[1] + k)];
  };
  for (int i = 0; i < n[0]; ++i)
    for (int j = 0; j < n[1]; ++j)
      for (int k = 0; k < n[2]; ++k)
        at(i, j, k) = values[static_cast<std::size_t>((i * n[1] + j) * n[2] + k)];

  // Along one axis after the other; lines that the others have not filled yet are zero and stay so
  for (int axis = 0; axis < 3; ++axis) {
    const auto solver = collocation(n[axis]);
    const int second = (axis + 1) % 3, third = (axis + 2) % 3;
    const auto entry = [&](int along, int s, int t) -> double& {
      int index[3];
      index[axis] = along, index[second] = s, index[third] = t;
      return at(index[0], index[1], index[2]);
    };
    VectorX line(m[axis]);
    for (int s = 0; s < m[second]; ++s)
      for (int t = 0; t < m[third]; ++t) {
        line.setZero();
        for (int i = 0; i < n[axis]; ++i) line[i] = entry(i, s, t);
        line = solver.solve(line).eval();
        for (int i = 0; i < m[axis]; ++i) entry(i, s, t) = line[i];
      }
  }
  return of(axes, std::move(coefficients));
}

void QuinticSpline3::evaluate(const Vector3& x, Value& value, bool with_hessian) const {
  QuinticSplineCell cell;
  cell.corner = coefficients_.data();
  cell.stride0 = stride_[0];
  cell.stride1 = stride_[1];
  for (std::size_t k = 0; k < 3; ++k) {
    const double steps = (x[Eigen::Index(k)] - axes_[k].lower) * per_step_[k];
    const int first = std::clamp(static_cast<int>(std::floor(steps)), 0, axes_[k].nodes - 2);
    cell.corner += first * stride_[k];
    cell.inside[k] = steps - first;
    cell.per_step[k] = per_step_[k];
  }
  const QuinticSplineKernels& kernel = kernels<QuinticSplineKernels>();
  QuinticSplineResult result;
  (with_hessian ? kernel.hessian : kernel.gradient)(cell, result);
  value.f = result.f;
  value.gradient = Vector3(result.gradient[0], result.gradient[1], result.gradient[2]);
  if (!with_hessian) return;
  const double* h = result.hessian;
  value.hessian << h[0], h[3], h[4], h[3], h[1], h[5], h[4], h[5], h[2];
}

}  // namespace furrow
