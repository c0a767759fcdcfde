// SPDX-License-Identifier: GPL-2.0-or-later
#include "statistics/resistance_parts.h"

#include <cmath>

namespace furrow {

namespace {

/// A part and the channels [J] whose change over the window it is.
struct Part {
  const char* name;
  std::vector<std::string> channels;
};

const std::vector<Part>& parts_of_resistance() {
  static const std::vector<Part> list = {
      {"compaction", {"compaction_work"}},
      {"bulldozing", {"bulldozing_work"}},
      {"grains, friction included", {"grain_work"}},
      {"friction of wheel and ground", {"friction_loss"}},
      {"wheel or tyre", {"wheel_loss", "stored_energy"}},
      {"damping of the rig", {"damping_loss"}},
      {"inertia", {"kinetic_energy", "ground_kinetic_energy"}},
      {"radiation", {"radiated_work"}},
      {"grid and contact damping", {"grid_loss", "contact_damping_loss"}},
  };
  return list;
}

}  // namespace

ResistanceParts resistance_parts(const History& history, const Window& window) {
  ResistanceParts result;
  const double travel = std::abs(window.distance);
  if (!(travel > 0.0)) return result;
  const auto change = [&](const std::vector<std::string>& channels) {
    double sum = 0.0;
    for (const std::string& name : channels) {
      const std::vector<double> column = history.column(name);
      sum += column[window.last - 1] - column[window.first];
    }
    return sum / travel;
  };
  const std::vector<std::string> works = {"drive_work", "load_work"};
  for (const Part& part : parts_of_resistance())
    for (const std::string& channel : part.channels)
      if (!history.has(channel)) return result;
  if (!history.has(works[0]) || !history.has(works[1])) return result;

  result.whole = result.unexplained = change(works);
  for (const Part& part : parts_of_resistance()) {
    const double force = change(part.channels);
    if (force == 0.0) continue;
    result.parts.push_back({part.name, force});
    result.unexplained -= force;
  }
  return result;
}

}  // namespace furrow
