// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/rig/slip.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

const std::vector<std::string>& slip_definition_words() {
  // order of SlipDefinition
  static const std::vector<std::string> words{"larger_speed", "rim_speed", "vehicle_speed"};
  return words;
}

SlipDefinition slip_definition(const std::string& word) {
  const auto& words = slip_definition_words();
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) throw Error(fmt::format("no slip definition '{}'", word));
  return static_cast<SlipDefinition>(found - words.begin());
}

std::string slip_formula(SlipDefinition definition) {
  switch (definition) {
    case SlipDefinition::larger_speed:
      return "(v_rim - v)/max(|v_rim|, |v|)";
    case SlipDefinition::rim_speed:
      return "(v_rim - v)/v_rim";
    case SlipDefinition::vehicle_speed:
      return "(v_rim - v)/v";
  }
  return {};
}

double slip(SlipDefinition definition, double rim, double vehicle) {
  double denominator = std::max(std::abs(rim), std::abs(vehicle));
  if (definition == SlipDefinition::rim_speed) denominator = rim;
  if (definition == SlipDefinition::vehicle_speed) denominator = vehicle;
  if (!(std::abs(denominator) > 0.0))
    throw StateError(
        fmt::format("slip {} is not defined at a rim speed of {} m/s and a vehicle speed of {} m/s",
                    slip_formula(definition), rim, vehicle));
  return (rim - vehicle) / denominator;
}

double rim_speed(SlipDefinition definition, double slip, double vehicle) {
  if (!(std::isfinite(vehicle) && vehicle > 0.0))
    throw StateError(fmt::format(
        "a slip of {} sets no rim speed at a vehicle speed of {} m/s; allowed: a speed > 0", slip,
        vehicle));
  const bool braking = slip < 0.0;
  const bool by_vehicle = definition == SlipDefinition::vehicle_speed ||
                          (definition == SlipDefinition::larger_speed && braking);
  if (!std::isfinite(slip) || (by_vehicle ? slip < -1.0 : slip >= 1.0))
    throw StateError(fmt::format("no forward spin has a slip {} of {}; allowed: {}",
                                 slip_formula(definition), slip,
                                 definition == SlipDefinition::larger_speed ? "-1 <= slip < 1"
                                 : definition == SlipDefinition::rim_speed  ? "slip < 1"
                                                                            : "slip >= -1"));
  return by_vehicle ? vehicle * (1.0 + slip) : vehicle / (1.0 - slip);
}

}  // namespace furrow
