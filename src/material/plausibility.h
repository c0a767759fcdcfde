// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Checks density and stiffness of a material against values in nature, which finds most wrong
/// units.

#include <string>
#include <vector>

#include "material/material.h"

namespace furrow {

/// @throws InputError for a density or a speed of sound that no matter has, and for a ratio of
/// moduli at which rounding dominates the stress
void check_plausible(const Material& material);

/// Warnings about values that are unusual for ground or tyre, a sentence each.
std::vector<std::string> doubts(const Material& material);

}  // namespace furrow
