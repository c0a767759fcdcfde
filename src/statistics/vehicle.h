// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The wheels of one vehicle, which roll together in one run.

#include <vector>

#include "furrow/statistics/resistance.h"

namespace furrow {

/// Resistance of a vehicle over the stretch of time in which all wheels are steady.
struct VehicleResistance {
  Window window;                   ///< of the first wheel
  std::vector<Resistance> wheels;  ///< resistance of each wheel over this stretch
  /// values for all wheels: force_z [N], resistance_coefficient, drawbar_pull [N]; sums, ratios of
  /// sums
  std::vector<SteadyValue> values;
  ResistanceParts parts;  ///< of all wheels
};

/// @param histories with rows at the same times, as measure_resistance() needs them
/// @throws Error for histories whose rows are not of the same times, or that have no common
/// stretch; what measure_resistance() throws
VehicleResistance measure_vehicle(const std::vector<History>& histories,
                                  const ResistanceOptions& options = {});

}  // namespace furrow
