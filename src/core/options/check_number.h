// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Checks of values that no Schema has read, such as the members of a parameter struct. Errors have
/// the words of a Schema.

#include <string>

#include "furrow/core/options/options.h"

namespace furrow {

/// @param where names the number: "tyre, mass of the rim"
/// @throws InputError "tyre, mass of the rim is -1; allowed: a number > 0 [kg]" for a value that is
/// out of range or not finite
void check_number(double value, const Range& range, const std::string& where,
                  const std::string& unit = "");

/// @throws InputError "tyre, elements around is 6; allowed: an integer in [12, 2000]"
void check_integer(long value, const Range& range, const std::string& where);

/// Requires a condition. @throws InputError with these texts unless it is fulfilled
void need(bool fulfilled, const std::string& where, const std::string& problem,
          const std::string& allowed, const std::string& remedy = "");

}  // namespace furrow
