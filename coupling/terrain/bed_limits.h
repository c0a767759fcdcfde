// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Can there be such a bed, and has it become one? Before the minutes that it takes, and after.

#include <string>
#include <vector>

#include "core/options.h"
#include "coupling/terrain/bed_facts.h"
#include "coupling/terrain/bed_surface.h"

namespace furrow::coupling {

/// Over the mean diameter, in the beds that come with Furrow: 0.85, 1 and 1.15 of it, in equal
/// numbers.
inline constexpr double smallest_grain = 0.85;

/// Of the bed, in mean diameters.
inline constexpr double least_size = 2.0;

/// Sizes against grains, memory, and time step, as far as the parameters have the names that the
/// beds of inputs/beds have: length, width, depth, diameter, density, bulk, step; young and
/// poisson, or stiffness and unloading, or modulus.
/// @throws InputError
void check_bed_parameters(const Options& options);

/// What may be meant but hardly is, a sentence each: coefficients of friction, densities, a bed
/// that takes hours.
std::vector<std::string> doubts_of_bed(const Options& options);

/// @throws StateError for grains that flew apart, or have sunk far below the surface
void check_bed(const BedFacts& facts, const BedSurface& surface);

}  // namespace furrow::coupling
