// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/core/options/usual_range.h"

#include <algorithm>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

// Soils: from fresh snow to cemented ground [Wong2008, Table 2.3], widened ten times. Moduli: from
// snow and rubber (0.3 to 5 MPa [Treloar1975]) to rock. M: a friction angle of 2 degrees has 0.07,
// snow up to 5.
const std::vector<UsualRange>& usual_ranges() {
  static const std::vector<UsualRange> table = {
      {"c", "Pa", Range::closed(20.0, 5e6), true, "kPa times 1000, psi times 6895"},
      {"phi", "degrees", Range::closed(2.0, 48.0), true, "radians times 57.3"},
      {"beta", "degree", Range::closed(4.0, 80.0), true,
       "radians times 57.3; of tan(beta) the arc tangent in degrees"},
      {"M", "", Range::closed(0.07, 5.0), false, "M is a ratio q/p, no angle"},
      {"density", "kg/m3", Range::closed(40.0, 3000.0), false, "g/cm3 times 1000, kN/m3 times 102"},
      {"d_density", "kg/m3", Range::closed(40.0, 3000.0), false,
       "g/cm3 times 1000, kN/m3 times 102"},
      {"rho", "kg/m3", Range::closed(40.0, 3000.0), false, "g/cm3 times 1000, kN/m3 times 102"},
      {"E", "Pa", Range::closed(2e4, 1e11), false, "kPa times 1000, MPa times 1e6"},
      {"G", "Pa", Range::closed(1e4, 5e10), false, "kPa times 1000, MPa times 1e6"},
      {"stress", "Pa", Range::closed(100.0, 1e9), false, "kPa times 1000"},
      {"strain", "", Range::closed(1e-6, 0.9), true, "percent over 100"},
      {"k_c", "N/m^(n+1)", Range::closed(-5e6, 5e7), false, "kN/m^(n+1) times 1000"},
      {"k_phi", "N/m^(n+2)", Range::closed(1e4, 1e9), false, "kN/m^(n+2) times 1000"},
      {"Bekker's n", "", Range::closed(0.1, 3.0), false, "it is a number without unit"},
      {"K", "m", Range::closed(5e-4, 0.3), false, "cm over 100, mm over 1000"},
      {"cone_index", "Pa", Range::closed(5e3, 2e7), false, "kPa times 1000, psi times 6895"},
  };
  return table;
}

std::string UsualRange::remedy() const { return unit.empty() ? hint : "give SI units: " + hint; }

std::string UsualRange::warning(double value) const {
  if (contains(value)) return {};
  const std::string of_unit = unit.empty() ? "" : " " + unit;
  return fmt::format("is {:g}{}; usual is {:g} to {:g}{}{}; {}", value, of_unit, range.lower,
                     range.upper, of_unit, zero ? ", or 0" : "", remedy());
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
