// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/large_stretch.h"

#include <Eigen/Eigenvalues>

#include "furrow/core/types.h"

namespace furrow {

bool large_stretch(const double* x, double* log_u, double* inverse_u) {
  Matrix3 c;
  c << 1.0 + x[0], x[3], x[5], x[3], 1.0 + x[1], x[4], x[5], x[4], 1.0 + x[2];
  if (!c.allFinite()) return false;
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(c);
  if (!(eigen.eigenvalues().minCoeff() > 0.0)) return false;
  const Matrix3& v = eigen.eigenvectors();
  const Matrix3 l =
      v * (0.5 * eigen.eigenvalues().array().log()).matrix().asDiagonal() * v.transpose();
  const Matrix3 u = v * eigen.eigenvalues().array().rsqrt().matrix().asDiagonal() * v.transpose();
  const int row[6] = {0, 1, 2, 0, 1, 0};
  const int column[6] = {0, 1, 2, 1, 2, 2};
  for (int k = 0; k < 6; ++k) {
    log_u[k] = l(row[k], column[k]);
    inverse_u[k] = u(row[k], column[k]);
  }
  return true;
}

}  // namespace furrow
