// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Logarithm and inverse of a stretch of any size, by eigenvalues, for the rare large steps of
/// kinematics.h. Plain data only: kernels of every instruction set include this header.

namespace furrow {

/// ln U and U^-1 of C = U^2 = I + X. Six components each: xx, yy, zz, xy, yz, xz.
/// @return false, with nothing written, when C is not finite or not positive definite
bool large_stretch(const double* x, double* log_u, double* inverse_u);

}  // namespace furrow
