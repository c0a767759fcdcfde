// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/shell/natural_modes.h"

#include <algorithm>
#include <cmath>

#include <Eigen/SparseCholesky>
#include <Spectra/SymEigsShiftSolver.h>
#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// (A - sigma I)^-1 as Spectra asks for it.
class ShiftedInverse {
 public:
  using Scalar = double;

  explicit ShiftedInverse(const Sparse& matrix) : matrix_(matrix) {
    factors_.analyzePattern(matrix_);
  }

  Eigen::Index rows() const { return matrix_.rows(); }
  Eigen::Index cols() const { return matrix_.cols(); }
  void set_shift(double sigma) {
    Sparse shifted = matrix_;
    shifted.diagonal().array() -= sigma;
    factors_.factorize(shifted);
    if (factors_.info() != Eigen::Success)
      throw StateError("natural modes: the stiffness cannot be factorised");
  }
  void perform_op(const double* in, double* out) const {
    Eigen::Map<VectorX>(out, rows()) = factors_.solve(Eigen::Map<const VectorX>(in, rows()));
  }
  /// Number of eigenvalues below the shift: A - sigma I = P^T L D L^T P has as many negative ones
  /// as D.
  Eigen::Index count_below() const { return (factors_.vectorD().array() < 0.0).count(); }

 private:
  const Sparse& matrix_;
  Eigen::SimplicialLDLT<Sparse> factors_;
};

// Relative distance above the highest eigenvalue found, up to which its multiplicity is counted
constexpr double separation = 1e-6;
constexpr double precision = 1e-12;
constexpr int max_restarts = 1000;

/// The lowest eigenvalues, ascending, with their vectors.
/// @throws StateError when the state is not stable, or they do not converge
std::pair<VectorX, Eigen::MatrixXd> lowest(ShiftedInverse& inverse, int count) {
  const Eigen::Index size = inverse.rows();
  const Eigen::Index subspace = std::min<Eigen::Index>(size, 4 * count + 20);
  // makes the shift 0
  Spectra::SymEigsShiftSolver<ShiftedInverse> solver(inverse, count, subspace, 0.0);
  if (const Eigen::Index unstable = inverse.count_below(); unstable > 0)
    throw StateError(fmt::format(
        "natural modes: in {} directions the structure is not in stable equilibrium; bring it to "
        "rest more precisely, or it has snapped or wrinkled",
        unstable));
  solver.init();
  solver.compute(Spectra::SortRule::LargestMagn, max_restarts, precision,
                 Spectra::SortRule::SmallestAlge);
  if (solver.info() != Spectra::CompInfo::Successful)
    throw StateError(fmt::format("natural modes: {} modes did not converge; request fewer", count));
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace

NaturalModes natural_modes(RelaxingStructure& structure, const NodeNeighbours& neighbours,
                           int count) {
  const FreeComponents free(structure.nodes());
  if (count < 1 || count >= free.count())
    throw InputError("natural modes, their number", fmt::format("is {}", count),
                     fmt::format("1 to {}", free.count() - 1));
  const TangentStiffness tangent = tangent_stiffness(structure, free, neighbours);
  const VectorX root = free.mass().cwiseSqrt().cwiseInverse();
  const Sparse matrix = root.asDiagonal() * tangent.matrix * root.asDiagonal();

  ShiftedInverse inverse(matrix);
  const auto [eigenvalue, vector] = lowest(inverse, count);
  inverse.set_shift(eigenvalue[count - 1] * (1.0 - separation));
  if (const Eigen::Index below = inverse.count_below(); below >= count)
    throw StateError(fmt::format("natural modes: {} of the lowest {} were missed; request more",
                                 below - count + 1, below));

  NaturalModes modes;
  modes.asymmetry = tangent.asymmetry;
  modes.frequency = eigenvalue.cwiseSqrt() / (2.0 * pi);
  for (int i = 0; i < count; ++i) {
    Matrix3X shape =
        free.displacements(vector.col(i).cwiseProduct(root), structure.nodes().count());
    Eigen::Index row, column;
    shape.cwiseAbs().maxCoeff(&row, &column);
    modes.shape.push_back(shape / shape(row, column));
  }
  return modes;
}

}  // namespace furrow
