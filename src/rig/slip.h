// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The definitions of slip (theory: symbols, eq. 5). Driving is positive in all of them. v_rim:
/// spin rate times radius; v: speed of the axle in the wheel plane.

#include <string>
#include <vector>

namespace furrow {

enum class SlipDefinition {
  /// (v_rim - v)/max(|v_rim|, |v|): -1 locked, +1 spinning on the spot (Furrow, [Pavlov2024])
  larger_speed,
  rim_speed,  ///< (v_rim - v)/v_rim: equal for a driven wheel; -infinity locked [Wong2008]
  /// (v_rim - v)/v: equal for a braked wheel; +infinity on the spot ([Shoop2001] eq 28)
  vehicle_speed,
};

/// larger_speed, rim_speed, vehicle_speed
const std::vector<std::string>& slip_definition_words();
SlipDefinition slip_definition(const std::string& word);  ///< @throws Error for another word
/// Text for tables: "(v_rim - v)/max(|v_rim|, |v|)".
std::string slip_formula(SlipDefinition definition);

/// Slip of a wheel from its speeds [m/s]. @throws StateError where the definition divides by zero
double slip(SlipDefinition definition, double rim_speed, double vehicle_speed);
/// Rim speed that gives a slip at a vehicle speed [m/s].
/// @throws StateError for a vehicle speed <= 0, or for a slip that no forward spin has: allowed are
/// -1 <= larger_speed < 1, rim_speed < 1, vehicle_speed >= -1
double rim_speed(SlipDefinition definition, double slip, double vehicle_speed);

}  // namespace furrow
