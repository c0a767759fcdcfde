// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Checks of numbers on the command line.

#include <CLI/CLI.hpp>
#include <string>

#include "furrow/core/options/options.h"

namespace furrow {

/// Refuses what is no number of a range, in the words of a Schema:
/// "--load: is nan; allowed: a number in [1, 1e+06] [N]".
CLI::Validator within(const Range& range, const std::string& unit = "");

}  // namespace furrow
