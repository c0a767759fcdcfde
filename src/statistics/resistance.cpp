// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/statistics/resistance.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/statistics/free_travel.h"
#include "furrow/statistics/rig_stage.h"

namespace furrow {

namespace {

// Axle torque over load times radius, below which it is rounding: the wheel is towed
constexpr double no_torque = 1e-9;
// Difference of the forces in two frames over the load, above which it is more than rounding
constexpr double same_frame = 1e-9;
// Lateral force over the load, below which it is that of a wheel that runs straight
constexpr double noise_sideways = 0.02;

/// True if another value of the verdict has the same force.
bool repeats_another(const SteadyValue& value) {
  return value.name == "tractive_force" || value.name == "force_x" || value.name == "force_y";
}

bool is_sideways(const SteadyValue& value) {
  return value.name == "lateral_force" || value.name == "overturning_moment" ||
         value.name == "aligning_moment";
}

std::vector<double> part_of(const History& history, const std::string& channel,
                            const Window& window) {
  const std::vector<double> column = history.column(channel);
  return {column.begin() + static_cast<std::ptrdiff_t>(window.first),
          column.begin() + static_cast<std::ptrdiff_t>(window.last)};
}

bool any_not_zero(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double value) { return value != 0.0; });
}

/// Marks the inputs: a slip or torque that does not change, and the pull of an axle that is free
/// without others. A towed wheel answers with its slip, whether this changes or not.
void mark_imposed(std::vector<SteadyValue>& values, bool driven, bool pull_is_given) {
  for (SteadyValue& value : values) {
    const bool constant = value.standard_error == 0.0;
    if (value.name == "slip") value.imposed = driven && constant;
    if (value.name == "drive_torque") value.imposed = constant;
    if (value.name == "drawbar_pull" || value.name == "net_traction_coefficient" ||
        value.name == "resistance_coefficient")
      value.imposed = pull_is_given;
    if (value.imposed) value.standard_error = 0.0;
  }
}

/// Gives a quantity and its negative one standard error, the larger one.
void share_error_of_negatives(std::vector<SteadyValue>& values, const std::string& first,
                              const std::string& second) {
  const auto named = [&](const std::string& name) -> SteadyValue& {
    return *std::find_if(values.begin(), values.end(),
                         [&](const SteadyValue& value) { return value.name == name; });
  };
  SteadyValue &a = named(first), &b = named(second);
  const double larger = std::max(a.standard_error, b.standard_error);
  if (std::abs(a.mean + b.mean) <= larger) a.standard_error = b.standard_error = larger;
}

/// Radius of the wheel [m], from its fastest turn; 0 where the history does not have it.
double radius_of(const History& history) {
  if (!history.has("rim_speed") || !history.has("spin_rate")) return 0.0;
  const std::vector<double> spin = history.column("spin_rate"), rim = history.column("rim_speed");
  const auto fastest = std::max_element(
      spin.begin(), spin.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  if (fastest == spin.end() || *fastest == 0.0) return 0.0;
  return rim[static_cast<std::size_t>(fastest - spin.begin())] / *fastest;
}

/// Spacing of rows [s]. @throws Error when one step between rows is longer than one and a half mean
/// ones
double spacing_of(const std::vector<double>& time) {
  const double spacing = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  for (std::size_t i = 1; i < time.size(); ++i)
    if (!(time[i] > time[i - 1] && time[i] - time[i - 1] < 1.5 * spacing))
      throw Error(
          fmt::format("the rows of the history are not equally spaced: {} s is followed by {} s, "
                      "the mean spacing is {:.3g} s; "
                      "rows are missing or were recorded with different intervals",
                      time[i - 1], time[i], spacing));
  return spacing;
}

}  // namespace

bool Resistance::has(const std::string& name) const {
  return std::any_of(values.begin(), values.end(),
                     [&](const SteadyValue& value) { return value.name == name; });
}

const SteadyValue& Resistance::value(const std::string& name) const {
  const auto found = std::find_if(values.begin(), values.end(),
                                  [&](const SteadyValue& value) { return value.name == name; });
  if (found == values.end()) throw Error(fmt::format("no steady value '{}'", name));
  return *found;
}

const SteadyValue& Resistance::coefficient() const {
  return value(driven ? "net_traction_coefficient" : "resistance_coefficient");
}

const SteadyValue& Resistance::answer() const { return axle_free ? value("slip") : coefficient(); }

std::string plain_name(const std::string& name) {
  std::string title = name;
  std::replace(title.begin(), title.end(), '_', ' ');
  return title;
}

std::vector<double> linearised_ratio(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size() || a.empty())
    throw Error(fmt::format("a ratio of {} and {} values", a.size(), b.size()));
  const double sum_a = std::accumulate(a.begin(), a.end(), 0.0),
               sum_b = std::accumulate(b.begin(), b.end(), 0.0);
  if (!(std::abs(sum_b) > 0.0)) throw StateError("a ratio to a quantity whose mean is zero");
  const double ratio = sum_a / sum_b, mean_b = sum_b / static_cast<double>(b.size());
  std::vector<double> series(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) series[i] = ratio + (a[i] - ratio * b[i]) / mean_b;
  return series;
}

std::vector<Resistance> measure_curve(const History& history, int stretches) {
  const std::vector<double> time = history.column("time");
  const double begin = time[first_row_of_cruise(history)],
               duration = (time.back() - begin) / stretches;
  std::vector<Resistance> curve;
  for (int n = 0; n < stretches; ++n) {
    ResistanceOptions options;
    options.window.from_time = begin + n * duration;
    options.window.to_time = n + 1 < stretches ? begin + (n + 1) * duration : time.back();
    options.window.whole_pitches = true;
    curve.push_back(measure_resistance(history, options));
    for (SteadyValue& value : curve.back().values)
      value.standard_error = value.drift_error / std::sqrt(12.0);
  }
  return curve;
}

Resistance measure_resistance(const History& history, const ResistanceOptions& options) {
  Resistance result;
  if (!options.window.given()) {
    const TravelVerdict verdict = judge_travel(history, first_row_of_cruise(history));
    if (!verdict.sentence.empty()) throw StateError(verdict.sentence);
  }
  result.window = select_window(history, options.window,
                                {hub_drop_channel, "force_x", "force_z", "drive_torque", "slip"});
  const Window& window = result.window;
  const double spacing = spacing_of(part_of(history, "time", window));
  const auto part = [&](const std::string& channel) { return part_of(history, channel, window); };
  const auto add = [&](const std::string& name, const std::string& unit,
                       const std::vector<double>& values, double reference) {
    result.values.push_back(
        analyse_steady(name, unit, values, spacing, reference, options.criteria));
  };

  const std::vector<double> force_z = part("force_z"), drawbar_pull = part("drawbar_pull");
  if (!any_not_zero(force_z))
    throw StateError(
        fmt::format("the wheel carries no load in the window ({}): it has not touched the ground; "
                    "choose a later window, such as the cruise, which is the default",
                    window.how));
  std::vector<double> resistance = part("force_x");
  for (double& force : resistance) force = -force;

  const double radius = radius_of(history);
  add(hub_drop_channel, "m", part(hub_drop_channel), depth_scale * radius);
  if (history.has(tyre_deflection_channel) && any_not_zero(part(tyre_deflection_channel)))
    for (const char* depth : {tyre_deflection_channel, rut_depth_channel})
      add(depth, "m", part(depth), depth_scale * radius);
  add("force_z", "N", force_z, 0.0);
  const double force_scale = coefficient_scale * std::abs(result.values.back().mean),
               torque_scale = force_scale * radius;
  add("resistance_coefficient", "", linearised_ratio(resistance, force_z), coefficient_scale);
  add("drawbar_pull", "N", drawbar_pull, force_scale);
  add("net_traction_coefficient", "", linearised_ratio(drawbar_pull, force_z), coefficient_scale);
  add("drive_torque", "N m", part("drive_torque"), torque_scale);
  result.driven = std::abs(result.values.back().mean) > no_torque * torque_scale;
  add("slip", "", part("slip"), slip_scale);
  const AxleTravel travel = history.has(axle_free_channel)
                                ? static_cast<AxleTravel>(part(axle_free_channel).back())
                                : AxleTravel::held;
  result.axle_free = travel != AxleTravel::held;
  mark_imposed(result.values, result.driven, travel == AxleTravel::free);
  share_error_of_negatives(result.values, "resistance_coefficient", "net_traction_coefficient");
  if (history.has("tractive_force")) {
    const std::vector<double> tractive = part("tractive_force");
    add("tractive_force", "N", tractive, force_scale);
    const std::vector<double> along = part("force_x");
    for (std::size_t i = 0; i < along.size(); ++i)
      if (std::abs(along[i] - tractive[i]) > same_frame * std::abs(force_z[i])) {
        for (const char* name : {"force_x", "force_y"}) add(name, "N", part(name), force_scale);
        break;
      }
  }
  const bool sideways = history.has("lateral_force");
  if (sideways) {
    add("lateral_force", "N", part("lateral_force"), force_scale);
    add("overturning_moment", "N m", part("overturning_moment"), torque_scale);
    add("aligning_moment", "N m", part("aligning_moment"), torque_scale);
  }
  const bool straight = !sideways || std::abs(result.value("lateral_force").mean) <
                                         noise_sideways * std::abs(result.value("force_z").mean);
  result.parts = resistance_parts(history, window);

  if (!window.warning.empty()) result.reasons.push_back(window.warning);
  if (window.distance < options.shortest_distance)
    result.reasons.push_back(fmt::format(
        "the window is too short: the wheel travels {:.3g} m in it, {:.3g} m are needed",
        window.distance, options.shortest_distance));
  const std::string other = result.driven ? "resistance_coefficient" : "net_traction_coefficient";
  // Titles of values by the reason why they are not steady: those with the same reason share it.
  std::vector<std::pair<std::string, std::string>> titles_of_reason;
  for (const SteadyValue& value : result.values) {
    if (value.steady || value.imposed || value.name == other || repeats_another(value) ||
        (straight && is_sideways(value)))
      continue;
    const std::string why = value.verdict.substr(std::string("not steady: ").size());
    const auto same = std::find_if(titles_of_reason.begin(), titles_of_reason.end(),
                                   [&](const auto& known) { return known.first == why; });
    if (same == titles_of_reason.end())
      titles_of_reason.emplace_back(why, plain_name(value.name));
    else
      same->second += ", " + plain_name(value.name);
  }
  for (const auto& [why, titles] : titles_of_reason) result.reasons.push_back(titles + ": " + why);
  result.steady = result.reasons.empty();
  return result;
}

}  // namespace furrow
