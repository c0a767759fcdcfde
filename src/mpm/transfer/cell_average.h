// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Means over the particles of a cell, against volumetric locking (theory: continuum, eq. 15). With
/// quadratic splines and eight particles a cell, a motion that keeps the volume of every particle
/// hardly exists; one that keeps the volume of every cell does [Coombs2018], [Zhao2023].
///
/// Both means have the weights V J of the particles. The volume of a cell is therefore kept, and
/// the work of the mean pressure in the nodes' strain is that of the particles' pressure in the
/// mean strain: the energy that the grid loses is what the material gets.

#include "furrow/mpm/transfer/transfer.h"

namespace furrow {

/// Replaces a third of tr(H) on the diagonal of H by a third of its mean over the cell.
/// @param gradient  H, row by row, as of TransferKernels::gather_strain
void average_volume_change(const ParticleView& particles, double* const* gradient);

/// Lets the normal stresses of a view be copies with the mean pressure of the cell.
/// @param normal_stress  three arrays of the length of the view, for the copies [Pa]
void average_pressure(ParticleView& particles, double* const* normal_stress);

}  // namespace furrow
