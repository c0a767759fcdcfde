// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/statistics/vehicle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

/// The rows that all windows have. @throws Error when there are none
WindowRequest common_window(const std::vector<Resistance>& wheels) {
  double begin = -std::numeric_limits<double>::infinity(), end = -begin;
  for (const Resistance& wheel : wheels) {
    begin = std::max(begin, wheel.window.begin);
    end = std::min(end, wheel.window.end);
  }
  if (!(begin < end))
    throw Error(
        fmt::format("the wheels have no common stretch of cruise: one begins at {:.4g} s, "
                    "another ends at {:.4g} s",
                    begin, end));
  WindowRequest common;
  common.from_time = begin;
  common.to_time = end;
  return common;
}

std::vector<double> sum_in_window(const std::vector<History>& histories,
                                  const std::vector<Window>& windows, const std::string& channel) {
  std::vector<double> sum(windows.front().rows(), 0.0);
  for (std::size_t w = 0; w < histories.size(); ++w) {
    const std::vector<double> column = histories[w].column(channel);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += column[windows[w].first + i];
  }
  return sum;
}

}  // namespace

VehicleResistance measure_vehicle(const std::vector<History>& histories,
                                  const ResistanceOptions& options) {
  if (histories.empty()) throw Error("a vehicle without wheels");
  VehicleResistance vehicle;
  for (const History& history : histories)
    vehicle.wheels.push_back(measure_resistance(history, options));
  ResistanceOptions common = options;
  common.window = common_window(vehicle.wheels);
  std::vector<Window> windows;
  for (std::size_t w = 0; w < histories.size(); ++w) {
    vehicle.wheels[w] = measure_resistance(histories[w], common);
    windows.push_back(vehicle.wheels[w].window);
  }
  vehicle.window = windows.front();
  const std::vector<double> time = histories.front().column("time");
  for (std::size_t w = 0; w < histories.size(); ++w) {
    const std::vector<double> other = histories[w].column("time");
    const auto first = static_cast<std::ptrdiff_t>(windows[w].first);
    if (windows[w].rows() != vehicle.window.rows() ||
        !std::equal(other.begin() + first,
                    other.begin() + static_cast<std::ptrdiff_t>(windows[w].last),
                    time.begin() + static_cast<std::ptrdiff_t>(vehicle.window.first)))
      throw Error(
          "the rows of the wheels' histories are not of the same times: they are not of one run, "
          "or 'every' differs in their lines of wheel/history");
  }

  const double spacing =
      (vehicle.window.end - vehicle.window.begin) / static_cast<double>(vehicle.window.rows() - 1);
  const std::vector<double> force_z = sum_in_window(histories, windows, "force_z");
  std::vector<double> resistance = sum_in_window(histories, windows, "force_x");
  for (double& force : resistance) force = -force;
  const auto add = [&](const char* name, const char* unit, const std::vector<double>& series,
                       double reference) {
    vehicle.values.push_back(
        analyse_steady(name, unit, series, spacing, reference, options.criteria));
  };
  add("force_z", "N", force_z, 0.0);
  const double load = std::abs(vehicle.values.back().mean);
  add("resistance_coefficient", "", linearised_ratio(resistance, force_z), coefficient_scale);
  add("drawbar_pull", "N", sum_in_window(histories, windows, "drawbar_pull"),
      coefficient_scale * load);
  vehicle.parts = resistance_parts(histories, windows);
  return vehicle;
}

}  // namespace furrow
