// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Soil cards, as furrow-soil card writes them: parameters of the soil contact model.

#include <map>
#include <string>

namespace furrow {

/// By the names k_c, k_phi, n, c, phi [degrees], K and stiffness; SI units.
/// @throws InputError naming file and line
std::map<std::string, double> read_soil_card(const std::string& path);

}  // namespace furrow
