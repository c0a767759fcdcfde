// SPDX-License-Identifier: GPL-2.0-or-later
#include "tests/support/linear_static.h"

#include <Eigen/SparseCholesky>

#include "furrow/core/error.h"

namespace furrow::test {

Eigen::SparseMatrix<double> assemble_stiffness(
    const Matrix3X& x, const std::vector<Shell4::Quad>& quads, const ShellSection& section,
    const std::function<Vector3(const Vector3&)>& fibre) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(quads.size() * 576);
  for (const Shell4Element& element : shell4_elements(x, quads, fibre)) {
    const Matrix24 K = shell4_stiffness(element.shape, section);
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < 8; ++j) {
        const Matrix3 block = element.axes * K.block<3, 3>(3 * i, 3 * j) * element.axes.transpose();
        const int row = 6 * element.nodes[static_cast<std::size_t>(i / 2)] + 3 * (i % 2);
        const int column = 6 * element.nodes[static_cast<std::size_t>(j / 2)] + 3 * (j % 2);
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) entries.emplace_back(row + r, column + c, block(r, c));
      }
  }
  Eigen::SparseMatrix<double> matrix(6 * x.cols(), 6 * x.cols());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Matrix6X solve_linear(const Eigen::SparseMatrix<double>& K, const ShellNodes& nodes,
                      const Matrix6X& load) {
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

}  // namespace furrow::test
