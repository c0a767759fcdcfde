// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/core/symmetric_eigenvalues.h"

#include <Eigen/Eigenvalues>

namespace furrow {

VectorX symmetric_eigenvalues(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

}  // namespace furrow
