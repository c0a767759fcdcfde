// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Whether the density and stiffness of a material exist in nature: most numbers that do not come
/// from a wrong unit.

#include <string>
#include <vector>

#include "material/material.h"

namespace furrow {

/// @throws InputError for a density or a speed of sound that no matter has, and for a ratio of
/// moduli at which nothing but round-off would be left of a stress
void check_plausible(const Material& material);

/// What exists but hardly as ground or tyre, a sentence each.
std::vector<std::string> doubts(const Material& material);

}  // namespace furrow
