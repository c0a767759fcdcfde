// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Stiffness and time step that command bed chooses: `young auto pressure P`, `step auto`.

#include <string>
#include <utility>
#include <vector>

namespace furrow::coupling {

/// Mean overlap of grains over their diameter that `young auto` allows: 0.015 leaves the friction
/// angle what it is with stiff grains, 0.03 takes 6 degrees from it (inputs/validation/grains).
inline constexpr double chosen_overlap = 0.015;
/// Time step of `step auto` over the Rayleigh time, or the contact time of snow, of the smallest
/// grain.
inline constexpr double chosen_step = 0.2;

/// Young's modulus [Pa] of grains whose Hertz contacts overlap by a share of their diameter under a
/// pressure p [Pa] on the bed, share = (1.5 p/E*)^(2/3), E* = E/(2 (1 - nu^2)).
double young_for_overlap(double pressure, double poisson, double share);

/// Alternating names and values of a bed line.
using BedWords = std::vector<std::pair<std::string, std::string>>;

/// Puts numbers in the place of `auto`; takes `pressure` away, which young is chosen by.
/// @returns what was chosen, for the user; nothing where the line has no `auto`
/// @throws InputError where what the choice rests on is missing
std::string choose_bed_values(BedWords& words);

}  // namespace furrow::coupling
