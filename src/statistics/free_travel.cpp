// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/statistics/free_travel.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include "furrow/statistics/rig_stage.h"
#include "furrow/statistics/steady_state.h"

namespace furrow {

namespace {

constexpr std::size_t fewest_rows = 16;  // in the second half of the cruise
constexpr double stalled_share = 0.05, digging_share = 0.5, rest_share = 1e-3;
constexpr double minimum_growth = 0.1, minimum_sinking = 0.05;  // of the value
constexpr double levelling = 0.5;                               // of the growth before

/// The second half of the cruise, quarter by quarter.
struct Course {
  std::vector<double> values;
  double spacing;  // [s]

  double mean(std::size_t from, std::size_t to) const {
    return std::accumulate(values.begin() + static_cast<std::ptrdiff_t>(from),
                           values.begin() + static_cast<std::ptrdiff_t>(to), 0.0) /
           static_cast<double>(to - from);
  }
  double mean() const { return mean(0, values.size()); }
  /// Mean of the n-th quarter, 0 to 3.
  double quarter(std::size_t n) const {
    return mean(n * values.size() / 4, (n + 1) * values.size() / 4);
  }
  /// True if the growth is significant and larger than a share of the mean.
  bool grows(double share) const {
    const SteadyCriteria criteria{share, 2};
    const SteadyValue value = analyse_steady("", "", values, spacing, 0.0, criteria);
    return value.drift > share * std::abs(value.mean) && value.drift > 2.58 * value.drift_error;
  }
  bool levels_off() const {
    return quarter(3) - quarter(2) < levelling * (quarter(1) - quarter(0));
  }
  Course size() const {
    Course sizes = *this;
    for (double& value : sizes.values) value = std::abs(value);
    return sizes;
  }
};

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

bool runs_away(const Course& speed) {
  const Course size = speed.size();
  return size.grows(minimum_growth) && !size.levels_off();
}

}  // namespace

TravelVerdict judge_travel(const History& history, std::size_t first_of_cruise) {
  if (!history.has(axle_free_channel) || history.column(axle_free_channel).back() == 0.0)
    return {Travel::prescribed, ""};

  const std::size_t half = first_of_cruise + (history.size() - first_of_cruise) / 2;
  if (history.size() - half < fewest_rows) return {Travel::travels, ""};
  const std::vector<double> time = history.column("time");
  const double spacing = (time.back() - time[half]) / static_cast<double>(time.size() - half - 1);
  const auto course = [&](const char* name) {
    const std::vector<double> column = history.column(name);
    return Course{{column.begin() + static_cast<std::ptrdiff_t>(half), column.end()}, spacing};
  };
  const Course axle = course("velocity_x"), rim = course("rim_speed"),
               hub_drop = course(hub_drop_channel);
  const double v = axle.quarter(3), u = rim.quarter(3);
  const double fastest =
      std::max(largest(history.column("velocity_x")), largest(history.column("rim_speed")));
  const bool rim_rests = std::abs(u) <= rest_share * fastest;
  const bool axle_rests = std::abs(v) <= rest_share * fastest;
  const auto speeds = fmt::format("the axle moves at {:.3g} m/s, the rim at {:.3g} m/s", v, u);

  if (!axle_rests && runs_away(axle))
    return {Travel::runs_away,
            fmt::format("the wheel runs away: its speed grows from {:.3g} to {:.3g} m/s over the "
                        "second half of the cruise and does not level off",
                        axle.quarter(0), v)};
  if (!rim_rests && runs_away(rim))
    return {Travel::runs_away,
            fmt::format("the wheel spins away: its rim speed grows from {:.3g} to {:.3g} m/s over "
                        "the second half of the cruise and does not level off, while the axle "
                        "moves at {:.3g} m/s",
                        rim.quarter(0), u, v)};
  if (!rim_rests && std::abs(v) < digging_share * std::abs(u) && hub_drop.grows(minimum_sinking))
    return {Travel::digs_in,
            fmt::format("the wheel digs in: it sinks from {:.4g} to {:.4g} m over the second half "
                        "of the cruise; {}",
                        hub_drop.quarter(0), hub_drop.quarter(3), speeds)};
  if ((rim_rests && axle_rests) || (!rim_rests && std::abs(v) < stalled_share * std::abs(u)))
    return {Travel::stalled, fmt::format("the wheel is stalled: {}", speeds)};
  if (rim_rests ? v < 0.0 : v * u < 0.0)
    return {Travel::rolls_back, fmt::format("the wheel rolls back: {}", speeds)};
  return {Travel::travels, ""};
}

}  // namespace furrow
