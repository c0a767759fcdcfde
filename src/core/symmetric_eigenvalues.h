// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "furrow/core/types.h"

namespace furrow {

/// Eigenvalues of a symmetric matrix, ascending. Only its lower triangle is read.
VectorX symmetric_eigenvalues(const Eigen::MatrixXd& symmetric);

}  // namespace furrow
