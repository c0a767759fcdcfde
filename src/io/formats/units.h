// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Units in tables and cards that people write.

#include <string>

namespace furrow {

struct Unit {
  const char* name;  ///< lower case, without blanks, ^ and *
  const char* si;    ///< "Pa", "m", "" for a ratio
  double factor;     ///< of SI units in this one
};

/// Finds a unit by its name, such as "kPa", "kN/m²", "percent"; null for other texts.
const Unit* find_unit(const std::string& text);

/// All units of a kind, for messages.
std::string units_of(const std::string& si);

}  // namespace furrow
