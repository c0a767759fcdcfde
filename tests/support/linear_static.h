// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Small displacements of a shell at rest: sparse Cholesky, for checks and for starting values.

#include "shell/shell4.h"

namespace furrow {

/// Solves K u = f with the components held that nodes.free_to_move and .free_to_turn hold.
/// @param load 6 numbers a node: forces [N], moments [N m]
/// @returns 6 numbers a node: displacements [m], rotations [rad]
/// @throws StateError when the shell is not supported
Eigen::Matrix<double, 6, Eigen::Dynamic> solve_linear(
    const Shell4& shell, const ShellNodes& nodes,
    const Eigen::Matrix<double, 6, Eigen::Dynamic>& load);

}  // namespace furrow
