// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/usual_range.h"

#include <algorithm>

#include "core/error.h"

namespace furrow {

// From fresh snow to cemented ground [Wong2008, Table 2.3], widened ten times
const std::vector<UsualRange>& usual_ranges() {
  static const std::vector<UsualRange> table = {
      {"c", "Pa", Range::closed(20.0, 5e6), true, "kPa times 1000, psi times 6895"},
      {"phi", "degrees", Range::closed(2.0, 48.0), false, "radians times 57.3"},
      {"density", "kg/m3", Range::closed(40.0, 3000.0), false, "g/cm3 times 1000, kN/m3 times 102"},
      {"E", "Pa", Range::closed(2e4, 1e11), false, "kPa times 1000, MPa times 1e6"},
      {"stress", "Pa", Range::closed(100.0, 1e9), false, "kPa times 1000"},
      {"strain", "", Range::closed(1e-6, 0.9), true, "percent over 100"},
      {"k_c", "N/m^(n+1)", Range::closed(-5e6, 5e7), false, "kN/m^(n+1) times 1000"},
      {"k_phi", "N/m^(n+2)", Range::closed(1e4, 1e9), false, "kN/m^(n+2) times 1000"},
      {"n", "", Range::closed(0.1, 3.0), false, "n is a number without unit"},
      {"K", "m", Range::closed(5e-4, 0.3), false, "cm over 100, mm over 1000"},
      {"cone_index", "Pa", Range::closed(5e3, 2e7), false, "kPa times 1000, psi times 6895"},
  };
  return table;
}

const UsualRange* find_usual_range(const std::string& key, const std::string& unit) {
  const auto found =
      std::find_if(usual_ranges().begin(), usual_ranges().end(),
                   [&](const UsualRange& row) { return row.key == key && row.unit == unit; });
  return found == usual_ranges().end() ? nullptr : &*found;
}

const UsualRange& usual_range(const std::string& key) {
  for (const UsualRange& row : usual_ranges())
    if (row.key == key) return row;
  throw Error("there is no usual range of '" + key + "'");
}

}  // namespace furrow
