// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Checks the values of a material against values in nature, which finds most wrong units. The
/// bounds leave a margin around all ground from fresh snow to rock; plausibility.cpp has them with
/// their sources.

#include <string>
#include <vector>

#include "furrow/material/material.h"
#include "furrow/material/material_model.h"

namespace furrow {

/// @throws InputError for a density or a speed of sound that no matter has, and for a ratio of
/// moduli at which rounding dominates the stress
void check_plausible(const Material& material);

/// Warnings about stiffness and density that are unusual together for ground or tyre, a sentence
/// each.
std::vector<std::string> plausibility_warnings(const Material& material);

/// Warnings about the values of the sections "elasticity" and "hardening" of a material file.
std::vector<std::string> plausibility_warnings(const MaterialOptions& sections);

}  // namespace furrow
