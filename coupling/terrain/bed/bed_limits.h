// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Checks of a bed: whether there can be such a one, and whether it has become one.

#include <string>
#include <vector>

#include "furrow/core/options/options.h"
#include "coupling/terrain/bed/bed_facts.h"
#include "coupling/terrain/bed/bed_surface.h"

namespace furrow::coupling {

/// Smallest grain over the mean diameter. The beds that come with Furrow have 0.85, 1 and 1.15 of
/// it, in equal numbers.
inline constexpr double smallest_grain = 0.85;

/// Least size of a bed in mean diameters.
inline constexpr double minimum_size = 2.0;

/// Checks the size of the bed in grains, its memory and its time step. It knows the parameters of
/// inputs/beds by name: length, width, depth, diameter, density, bulk and step. Elasticity is young
/// and poisson, stiffness and unloading, or modulus. Parameters with other names are not checked.
/// @throws InputError
void check_bed_parameters(const Options& options);

/// Warnings about values that are allowed but hardly meant, a sentence each: coefficients of
/// friction, densities, a bed that takes hours.
std::vector<std::string> bed_warnings(const Options& options);

/// @throws StateError for grains that flew apart, or have sunk far below the surface
void check_bed(const BedFacts& facts, const BedSurface& surface);

}  // namespace furrow::coupling
