// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Small displacements of a shell at rest: assembled stiffness and sparse Cholesky, for checks.

#include <functional>
#include <vector>

#include <Eigen/SparseCore>

#include "furrow/shell/shell4.h"

namespace furrow::test {

using Matrix6X = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Stiffness of the stress-free shell, assembled from shell4_stiffness() of every element; 6 rows
/// and columns for each node: u then theta. Arguments as Shell4's.
Eigen::SparseMatrix<double> assemble_stiffness(const Matrix3X& x,
                                               const std::vector<Shell4::Quad>& quads,
                                               const ShellSection& section,
                                               const std::function<Vector3(const Vector3&)>& fibre);

/// Solves K u = f with the components held that nodes.free_to_move and .free_to_turn hold.
/// @param load a column for each node: forces [N], moments [N m]
/// @returns a column for each node: displacements [m], rotations [rad]
/// @throws StateError when the shell is not supported
Matrix6X solve_linear(const Eigen::SparseMatrix<double>& K, const ShellNodes& nodes,
                      const Matrix6X& load);

}  // namespace furrow::test
