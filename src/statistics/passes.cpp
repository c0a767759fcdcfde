// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/statistics/passes.h"

#include <algorithm>

#include "furrow/core/error.h"
#include "furrow/statistics/rig_stage.h"

namespace furrow {

int count_passes(const History& history) {
  if (!history.has(pass_channel) || history.size() == 0) return 1;
  return static_cast<int>(history.column(pass_channel).back());
}

History rows_of_pass(const History& history, int number) {
  const std::vector<double> pass = history.column(pass_channel),
                            stage = history.column(stage_channel);
  const std::size_t channels = history.channels().size();
  History part(history.channels());
  std::vector<double> row(channels);
  for (std::size_t i = 0; i < history.size(); ++i) {
    if (pass[i] != number || stage[i] >= static_cast<double>(RigStage::back)) continue;
    for (std::size_t c = 0; c < channels; ++c) row[c] = history.at(i, c);
    part.append(row);
  }
  return part;
}

std::vector<Resistance> measure_passes(const History& history, const ResistanceOptions& options) {
  std::vector<Resistance> passes;
  const auto cruise = static_cast<double>(RigStage::cruise);
  const int count = count_passes(history);
  for (int number = 1; number <= count; ++number) {
    const History rows = rows_of_pass(history, number);
    const std::vector<double> stage = rows.column(stage_channel);
    // the last pass may have ended before its cruise
    if (std::count(stage.begin(), stage.end(), cruise) > 1)
      passes.push_back(measure_resistance(rows, options));
  }
  return passes;
}

}  // namespace furrow
