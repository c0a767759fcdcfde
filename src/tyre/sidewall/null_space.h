// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Linear algebra of Newton's method with two equality constraints.

#include "furrow/core/types.h"

namespace furrow {

/// The null-space method [Nocedal2006]. The first two of the orthonormal axes span the gradients of
/// the constraints; the others are tangent to the manifold of the constraints. The axes are the
/// columns of Q in J^T = Q [triangle; 0], by Householder reflections: Q = P0 P1, P = I - 2 v v^T.
///
/// An object holds its working space: no function allocates.
class NullSpace {
 public:
  explicit NullSpace(Eigen::Index n);

  /// @param first, second gradients of the constraints: the rows of J, n numbers each
  void set_constraints(const VectorX& first, const VectorX& second);
  const Eigen::Matrix2d& triangle() const { return triangle_; }  ///< upper

  void to_axes(VectorX& vector) const;       ///< Q^T x, in place
  void from_axes(VectorX& vector) const;     ///< Q x, in place
  void to_axes(Eigen::MatrixXd& symmetric);  ///< Q^T H Q, in place

  /// Cholesky's factor of the tangent part, entries 2 to n - 1, of a matrix in these axes plus
  /// shift I. False when it is not positive definite.
  bool factorise(const Eigen::MatrixXd& hessian, double shift);
  /// Solves with the factor, in place, the tangent entries of a vector in these axes.
  void solve(VectorX& vector) const;

 private:
  Eigen::Index n_;
  VectorX reflector_[2];
  Eigen::Matrix2d triangle_;
  Eigen::MatrixXd factor_;
  VectorX work_;
};

}  // namespace furrow
