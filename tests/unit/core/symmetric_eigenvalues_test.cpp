// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/core/symmetric_eigenvalues.h"

#include <cmath>

#include <gtest/gtest.h>

namespace furrow::symmetric_eigenvalues_test {
namespace {

/// A chain of n masses and n + 1 springs has 2 - 2 cos(k pi/(n + 1)).
TEST(SymmetricEigenvalues, ChainOfSpringsHasItsClosedForm) {
  constexpr int n = 30;
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    K(i, i) = 2.0;
    if (i > 0) K(i, i - 1) = -1.0;  // the lower triangle alone is read
  }
  const VectorX values = symmetric_eigenvalues(K);
  ASSERT_EQ(values.size(), n);
  for (int k = 0; k < n; ++k)
    EXPECT_NEAR(values[k], 2.0 - 2.0 * std::cos((k + 1) * pi / (n + 1)), 1e-14) << k;
}

}  // namespace
}  // namespace furrow::symmetric_eigenvalues_test
