// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Values that soils, snow and rubber have, by key. A value outside has probably another unit:
/// Schema warns of it. Programs print this table as JSON, from which Python reads it. Keys whose
/// values depend on others, such as strengths on the density, are not here: plausibility.h looks at
/// them together.

#include <string>
#include <vector>

#include "furrow/core/options/options.h"

namespace furrow {

struct UsualRange {
  std::string key;   ///< "c", "k_phi"
  std::string unit;  ///< SI, degrees
  Range range;
  bool zero;         ///< 0 is usual too
  std::string hint;  ///< how other units become this one: "kPa times 1000"

  bool contains(double value) const { return range.contains(value) || (zero && value == 0.0); }
  /// Remedy for an unusual value: "give SI units: g/cm3 times 1000".
  std::string remedy() const;
  /// Warning: "is 0.3 kg/m3; usual is 40 to 3000 kg/m3; give SI units: g/cm3 times 1000"; empty for
  /// a usual value.
  std::string warning(double value) const;
};

const std::vector<UsualRange>& usual_ranges();
/// Finds the range of a key; null if the table does not have it in this unit.
const UsualRange* find_usual_range(const std::string& key, const std::string& unit);
/// @throws Error for a key that the table does not have
const UsualRange& usual_range(const std::string& key);

}  // namespace furrow
