// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The passes of a wheel in one rut, one by one.

#include <vector>

#include "furrow/statistics/resistance.h"

namespace furrow {

/// Number of passes; 1 for a history without the channel `pass`.
int count_passes(const History& history);
/// The rows of a pass, from 1, up to its way back.
History rows_of_pass(const History& history, int number);

/// Steady values of each pass that has a cruise, by measure_resistance().
std::vector<Resistance> measure_passes(const History& history, const ResistanceOptions& options);

}  // namespace furrow
