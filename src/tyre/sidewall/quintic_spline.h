// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A function of three variables as the quintic spline through its values on a uniform grid.

#include <array>
#include <vector>

#include "furrow/core/types.h"

namespace furrow {

/// Nodes of a grid along one variable: n equal steps from lower to upper, both included.
struct GridAxis {
  double lower = 0.0;
  double upper = 0.0;
  int nodes = 0;

  double step() const { return (upper - lower) / (nodes - 1); }
  double node(int i) const { return lower + i * step(); }
};

/// Tensor product of B-splines of degree 5 with knots at the nodes, not-a-knot at the two nodes
/// next to either end (C. de Boor, A Practical Guide to Splines): four times continuously
/// differentiable. Error h^6 in the value, h^5 in the gradient, h^4 in the second derivatives.
class QuinticSpline3 {
 public:
  struct Value {
    double f = 0.0;
    Vector3 gradient = Vector3::Zero();
    Matrix3 hessian = Matrix3::Zero();
  };

  QuinticSpline3() = default;
  /// @param values at the nodes, the last variable fastest; nodes0 * nodes1 * nodes2 of them
  /// @throws StateError for fewer than 6 nodes along an axis, another number of values, or values
  /// that are not finite
  static QuinticSpline3 through(const std::array<GridAxis, 3>& axes,
                                const std::vector<double>& values);
  /// Spline from the coefficients() of another. @throws StateError for another number of them
  static QuinticSpline3 of(const std::array<GridAxis, 3>& axes, std::vector<double> coefficients);

  const std::array<GridAxis, 3>& axes() const { return axes_; }
  const std::vector<double>& coefficients() const { return coefficients_; }

  /// Evaluates the spline at a point inside the grid; outside, the polynomial of the nearest cell
  /// is continued. The
  /// Hessian is left as it is unless asked for.
  void evaluate(const Vector3& x, Value& value, bool with_hessian) const;

 private:
  std::array<GridAxis, 3> axes_;
  std::array<double, 3> per_step_ = {};  // 1/step
  std::array<int, 3> stride_ = {};       // of the coefficients
  std::vector<double> coefficients_;     // (nodes0 + 4) (nodes1 + 4) (nodes2 + 4)
};

}  // namespace furrow
