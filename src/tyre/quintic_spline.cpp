// SPDX-License-Identifier: GPL-2.0-or-later
#include "tyre/quintic_spline.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <fmt/format.h>

#include "core/error.h"

namespace furrow {

namespace {

/// The six B-splines that are not zero in a cell, with derivatives, at 0 <= x <= 1 in steps.
struct Basis {
  std::array<double, 6> b, d, dd;

  Basis(double x, double per_step) {
    const double x2 = x * x, x3 = x2 * x, x4 = x3 * x, x5 = x4 * x, y = 1.0 - x, y2 = y * y,
                 y3 = y2 * y;
    const double s = 1.0 / 120.0, s1 = s * per_step, s2 = s1 * per_step;
    b = {s * y3 * y2,
         s * (5.0 * x5 - 20.0 * x4 + 20.0 * x3 + 20.0 * x2 - 50.0 * x + 26.0),
         s * (-10.0 * x5 + 30.0 * x4 - 60.0 * x2 + 66.0),
         s * (10.0 * x5 - 20.0 * x4 - 20.0 * x3 + 20.0 * x2 + 50.0 * x + 26.0),
         s * (-5.0 * x5 + 5.0 * x4 + 10.0 * x3 + 10.0 * x2 + 5.0 * x + 1.0),
         s * x5};
    d = {-5.0 * s1 * y2 * y2,
         s1 * (25.0 * x4 - 80.0 * x3 + 60.0 * x2 + 40.0 * x - 50.0),
         s1 * (-50.0 * x4 + 120.0 * x3 - 120.0 * x),
         s1 * (50.0 * x4 - 80.0 * x3 - 60.0 * x2 + 40.0 * x + 50.0),
         s1 * (-25.0 * x4 + 20.0 * x3 + 30.0 * x2 + 20.0 * x + 5.0),
         5.0 * s1 * x4};
    dd = {20.0 * s2 * y3,
          s2 * (100.0 * x3 - 240.0 * x2 + 120.0 * x + 40.0),
          s2 * (-200.0 * x3 + 360.0 * x2 - 120.0),
          s2 * (200.0 * x3 - 240.0 * x2 - 120.0 * x + 40.0),
          s2 * (-100.0 * x3 + 60.0 * x2 + 60.0 * x + 20.0),
          20.0 * s2 * x3};
  }
};

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
  std::array<int, 3> cell;
  std::array<double, 3> inside;
  for (std::size_t k = 0; k < 3; ++k) {
    const double steps = (x[Eigen::Index(k)] - axes_[k].lower) * per_step_[k];
    cell[k] = std::clamp(static_cast<int>(std::floor(steps)), 0, axes_[k].nodes - 2);
    inside[k] = steps - cell[k];
  }
  const Basis B0(inside[0], per_step_[0]), B1(inside[1], per_step_[1]), B2(inside[2], per_step_[2]);
  const double* corner =
      coefficients_.data() + cell[0] * stride_[0] + cell[1] * stride_[1] + cell[2];

  // Sums along axis 1, then 0, in rows of six coefficients along axis 2; indices count derivatives
  // along axes 0 and 1
  using Row = std::array<double, 6>;
  Row s00{}, s10{}, s01{}, s20{}, s11{}, s02{};
  for (std::size_t i = 0; i < 6; ++i) {
    Row r0{}, r1{}, r2{};
    const double* row = corner + static_cast<int>(i) * stride_[0];
    for (std::size_t j = 0; j < 6; ++j, row += stride_[1])
      for (std::size_t k = 0; k < 6; ++k) {
        r0[k] += B1.b[j] * row[k];
        r1[k] += B1.d[j] * row[k];
        if (with_hessian) r2[k] += B1.dd[j] * row[k];
      }
    for (std::size_t k = 0; k < 6; ++k) {
      s00[k] += B0.b[i] * r0[k];
      s10[k] += B0.d[i] * r0[k];
      s01[k] += B0.b[i] * r1[k];
      if (!with_hessian) continue;
      s20[k] += B0.dd[i] * r0[k];
      s11[k] += B0.d[i] * r1[k];
      s02[k] += B0.b[i] * r2[k];
    }
  }
  const auto dot = [](const std::array<double, 6>& b, const Row& row) {
    return b[0] * row[0] + b[1] * row[1] + b[2] * row[2] + b[3] * row[3] + b[4] * row[4] +
           b[5] * row[5];
  };
  value.f = dot(B2.b, s00);
  value.gradient = {dot(B2.b, s10), dot(B2.b, s01), dot(B2.d, s00)};
  if (!with_hessian) return;
  value.hessian(0, 0) = dot(B2.b, s20);
  value.hessian(1, 1) = dot(B2.b, s02);
  value.hessian(2, 2) = dot(B2.dd, s00);
  value.hessian(0, 1) = value.hessian(1, 0) = dot(B2.b, s11);
  value.hessian(0, 2) = value.hessian(2, 0) = dot(B2.d, s10);
  value.hessian(1, 2) = value.hessian(2, 1) = dot(B2.d, s01);
}

}  // namespace furrow
