// SPDX-License-Identifier: GPL-2.0-or-later
#include "tests/support/linear_static.h"

#include <Eigen/SparseCholesky>

#include "core/error.h"

namespace furrow {

using Matrix6X = Eigen::Matrix<double, 6, Eigen::Dynamic>;

Matrix6X solve_linear(const Shell4& shell, const ShellNodes& nodes, const Matrix6X& load) {
  const Eigen::SparseMatrix<double> K = shell.stiffness();
  std::vector<int> unknown(static_cast<std::size_t>(K.cols()), -1);
  int count = 0;
  for (Eigen::Index n = 0; n < nodes.count(); ++n)
    for (int k = 0; k < 6; ++k)
      if ((k < 3 ? nodes.free_to_move(k, n) : nodes.free_to_turn(k - 3, n)) != 0.0)
        unknown[static_cast<std::size_t>(6 * n + k)] = count++;

  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(K.nonZeros()));
  VectorX right(count);
  for (int c = 0; c < K.outerSize(); ++c) {
    const int column = unknown[static_cast<std::size_t>(c)];
    if (column < 0) continue;
    right[column] = load.data()[c];
    for (Eigen::SparseMatrix<double>::InnerIterator it(K, c); it; ++it)
      if (const int row = unknown[static_cast<std::size_t>(it.row())]; row >= 0)
        entries.emplace_back(row, column, it.value());
  }
  Eigen::SparseMatrix<double> reduced(count, count);
  reduced.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(reduced);
  if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 0.0))
    throw StateError("shell: it can move without strain; hold more of its nodes");
  const VectorX solution = factor.solve(right);
  Matrix6X displacement = Matrix6X::Zero(6, nodes.count());
  for (Eigen::Index i = 0; i < displacement.size(); ++i)
    if (const int row = unknown[static_cast<std::size_t>(i)]; row >= 0)
      displacement.data()[i] = solution[row];
  return displacement;
}

}  // namespace furrow
