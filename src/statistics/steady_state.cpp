// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/statistics/steady_state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/statistics/rig_stage.h"

namespace furrow {

namespace {

constexpr std::size_t mser_batch = 5;
/// Minima of the statistic that differ by less are the same: of 50 independent values it is known
/// to sqrt(2/50).
constexpr double mser_scatter = 1.2;
constexpr double longest_transient = 0.45;  // of the cruise; MSER looks for it in the first half

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double range_of(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

/// Differences so small that they are rounding, not a signal: of a prescribed slip, of the torque
/// of a free axle.
bool is_constant(const std::vector<double>& values, double reference = 0.0) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low <=
         std::max(1e-12, 1e-9 * std::max({std::abs(*high), std::abs(*low), reference}));
}

/// True if the longest transient that is allowed was left out, and the values that remain still
/// differ by more than is negligible.
bool ends_in_a_transient(std::size_t transient, const std::vector<double>& cruise) {
  if (static_cast<double>(transient) <= longest_transient * static_cast<double>(cruise.size()))
    return false;
  const std::vector<double> rest(cruise.begin() + static_cast<std::ptrdiff_t>(transient),
                                 cruise.end());
  return range_of(rest) > SteadyCriteria{}.negligible_drift * std::abs(mean_of(rest));
}

/// Two-sided 99 % quantile of Student's t, expansion of Cornish and Fisher about the normal one;
/// within 4 % from 3 degrees on, 0.3 % from 6.
double student_t99(double freedom) {
  const double z = 2.5758293035489004, z2 = z * z, n = freedom;
  return z * (1.0 + (z2 + 1.0) / (4.0 * n) + ((5.0 * z2 + 16.0) * z2 + 3.0) / (96.0 * n * n) +
              (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / (384.0 * n * n * n));
}

/// Two-sided 95 % quantile of Student's t for the mean of so many blocks, at least two.
double student_t95(std::size_t blocks) {
  constexpr std::array<double, 4> of_degrees = {12.706, 4.303, 3.182, 2.776};
  constexpr double of_more = 2.571;  // five degrees, an upper bound for more
  return blocks - 2 < of_degrees.size() ? of_degrees[blocks - 2] : of_more;
}

struct Blocking {
  double standard_error = 0.0;
  std::size_t blocks = 0, block_length = 1;
};

/// Blocks of one length, from the end; what is left over, the oldest values, is left out.
Blocking blocks_of(const std::vector<double>& values, std::size_t length) {
  const std::size_t count = values.size() / length, offset = values.size() - count * length;
  std::vector<double> means(count);
  for (std::size_t block = 0; block < count; ++block) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(offset + block * length);
    means[block] = std::accumulate(begin, begin + static_cast<std::ptrdiff_t>(length), 0.0) /
                   static_cast<double>(length);
  }
  const double mean = mean_of(means);
  double squares = 0.0;
  for (const double each : means) squares += (each - mean) * (each - mean);
  return {std::sqrt(squares / static_cast<double>(count * (count - 1))), count, length};
}

/// Lengthens the blocks until length^3 > 2 n (error/error of single values)^4; the longest, two
/// blocks, when none is long enough. The error of every length is noisy and oscillates for
/// oscillating values. The largest of all lengths so far counts, in the condition and as the
/// result, so that a random minimum does not end the search.
Blocking block_average(const std::vector<double>& values) {
  const Blocking single = blocks_of(values, 1);
  Blocking blocking = single;
  double largest = 0.0;
  for (std::size_t length = 1; values.size() / length >= 2;
       length = std::max(length + 1, length * 5 / 4)) {
    blocking = blocks_of(values, length);
    largest = blocking.standard_error = std::max(largest, blocking.standard_error);
    const double growth =
        single.standard_error > 0.0 ? blocking.standard_error / single.standard_error : 1.0;
    if (std::pow(static_cast<double>(length), 3) >
        2.0 * static_cast<double>(values.size()) * std::pow(growth, 4))
      break;
  }
  return blocking;
}

/// Slope of the least-squares line per value.
double slope_of(const std::vector<double>& values) {
  const double middle = 0.5 * static_cast<double>(values.size() - 1), mean = mean_of(values);
  double covariance = 0.0, spread = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double offset = static_cast<double>(i) - middle;
    covariance += offset * (values[i] - mean);
    spread += offset * offset;
  }
  return covariance / spread;
}

double half_difference(const std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  const auto early = static_cast<double>(middle - values.begin()),
             late = static_cast<double>(values.end() - middle);
  return std::accumulate(middle, values.end(), 0.0) / late -
         std::accumulate(values.begin(), middle, 0.0) / early;
}

bool has_stages(const History& history) { return history.has(stage_channel); }

/// Rows whose value lies in [from, to] of a growing column.
Window rows_between(const std::vector<double>& column, std::optional<double> from,
                    std::optional<double> to, const char* what, const char* unit) {
  const double lowest = column.front(), highest = column.back();
  const double begin = from.value_or(lowest), end = to.value_or(highest),
               slack = 1e-9 * (highest - lowest);
  if (!(begin >= lowest - slack && end <= highest + slack && begin < end))
    throw InputError(
        fmt::format("the window by {}", what), fmt::format("is {} to {} {}", begin, end, unit),
        fmt::format("a part of {} to {} {}, the begin before the end", lowest, highest, unit));
  Window window;
  window.first = static_cast<std::size_t>(
      std::lower_bound(column.begin(), column.end(), begin - slack) - column.begin());
  window.last = static_cast<std::size_t>(
      std::upper_bound(column.begin(), column.end(), end + slack) - column.begin());
  window.how = fmt::format("given by {}: {} to {} {}", what, begin, end, unit);
  return window;
}

/// The beginning of [first, last) goes up until the rows cover whole pitches of grousers; a row
/// counts for its spacing.
void trim_to_whole_pitches(const History& history, Window& window) {
  if (!history.has(grouser_channel) || window.rows() < 2) return;
  const std::vector<double> pitches = history.column(grouser_channel);
  const double end = pitches[window.last - 1];
  const double row = std::abs(end - pitches[window.first]) / static_cast<double>(window.rows() - 1);
  const auto covered = [&](std::size_t first) { return std::abs(end - pitches[first]) + row; };
  const double all = covered(window.first);
  if (all == 0.0) return;  // smooth, or without spin
  const double whole = std::floor(all + 0.5 * row);
  if (whole < 1.0) {
    if (!window.warning.empty()) window.warning += "; ";
    window.warning += "the window is shorter than the pitch of the grousers: run longer";
    return;
  }
  const auto error = [&](std::size_t first) { return std::abs(covered(first) - whole); };
  while (window.rows() > 2 && error(window.first + 1) < error(window.first)) ++window.first;
  window.how += fmt::format(", trimmed to {:.0f} whole pitches of grousers", whole);
}

/// Warning about a given window that begins before the cruise; else empty.
std::string begin_warning(const History& history, const Window& window) {
  const bool early = has_stages(history) && history.column(stage_channel)[window.first] <
                                                static_cast<double>(RigStage::cruise);
  return early ? "the window begins before the cruise, while the rig still settles or accelerates"
               : "";
}

}  // namespace

std::size_t first_row_of_cruise(const History& history) {
  if (!has_stages(history)) return 0;
  const std::vector<double> stages = history.column(stage_channel);
  const auto cruise = static_cast<double>(RigStage::cruise);
  const auto first = std::find(stages.begin(), stages.end(), cruise);
  if (first == stages.end())
    throw Error(
        "the history ends before the cruise begins: run longer, or shorten settle_time and "
        "accelerate_time");
  return static_cast<std::size_t>(first - stages.begin());
}

std::size_t mser_truncation(const std::vector<double>& values) {
  const std::size_t batches = values.size() / mser_batch;
  if (batches < 4) return 0;
  std::vector<double> means(batches);
  for (std::size_t i = 0; i < batches; ++i)
    means[i] =
        std::accumulate(values.begin() + static_cast<std::ptrdiff_t>(i * mser_batch),
                        values.begin() + static_cast<std::ptrdiff_t>((i + 1) * mser_batch), 0.0) /
        mser_batch;
  // running mean and sum of squares from the end (B. P. Welford 1962), so that offsets lose no
  // digits
  double mean = 0.0, squares = 0.0;
  std::vector<double> statistic(batches / 2 + 1);  // of each truncation
  for (std::size_t batch = batches; batch-- > 0;) {
    const auto count = static_cast<double>(batches - batch);
    const double change = means[batch] - mean;
    mean += change / count;
    squares += change * (means[batch] - mean);
    if (batch < statistic.size()) statistic[batch] = squares / (count * count);
  }
  const auto least = std::min_element(statistic.begin(), statistic.end());
  const auto is_minimum = [&](std::vector<double>::const_iterator at) {
    return *at <= mser_scatter * *least && (at == statistic.begin() || *at <= *(at - 1)) &&
           *at < *(at + 1);
  };
  auto best = statistic.begin();
  while (best != least && !is_minimum(best)) ++best;
  return static_cast<std::size_t>(best - statistic.begin()) * mser_batch;
}

Window select_window(const History& history, const WindowRequest& request,
                     const std::vector<std::string>& channels) {
  if (history.size() < 2)
    throw Error(fmt::format("the history has {} rows: nothing to take a mean of", history.size()));
  const std::vector<double> time = history.column("time"), x = history.column("x");
  const bool by_time = request.from_time || request.to_time,
             by_distance = request.from_distance || request.to_distance;
  if (by_time && by_distance)
    throw InputError("the window", "is given by time and by distance", "one of them",
                     "remove the other");

  Window window;
  if (by_time) {
    window = rows_between(time, request.from_time, request.to_time, "time", "s");
  } else if (by_distance) {
    std::vector<double> travelled(x.size());
    std::transform(x.begin(), x.end(), travelled.begin(),
                   [&](double value) { return value - x.front(); });
    window = rows_between(travelled, request.from_distance, request.to_distance, "distance", "m");
  } else {
    const std::size_t start = first_row_of_cruise(history);
    std::size_t transient = 0;
    std::string longest;
    bool unfinished = false;
    for (const std::string& name : channels) {
      std::vector<double> values = history.column(name);
      values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(start));
      const std::size_t truncation = is_constant(values) ? 0 : mser_truncation(values);
      if (truncation <= transient) continue;
      longest = name;
      transient = truncation;
      unfinished = ends_in_a_transient(truncation, values);
    }
    window.first = start + transient;
    window.last = history.size();
    window.automatic = true;
    window.how = fmt::format("cruise from {:.6g} s", time[start]);
    if (transient > 0)
      window.how += fmt::format(", transient of {:.4g} s left out (MSER-5 on {})",
                                time[window.first] - time[start], longest);
    if (unfinished)
      window.warning =
          fmt::format("the transient of {} fills nearly half of the cruise: run longer", longest);
  }
  if (window.automatic || request.whole_pitches) trim_to_whole_pitches(history, window);
  if (window.rows() < 2)
    throw Error(fmt::format("the window ({}) has {} row(s): widen it or record more often",
                            window.how, window.rows()));
  if (!window.automatic) window.warning = begin_warning(history, window);
  window.begin = time[window.first];
  window.end = time[window.last - 1];
  window.distance = x[window.last - 1] - x[window.first];
  return window;
}

SteadyValue analyse_steady(const std::string& name, const std::string& unit,
                           const std::vector<double>& values, double spacing, double reference,
                           const SteadyCriteria& criteria) {
  if (values.size() < 2)
    throw Error(fmt::format("{}: {} value(s) have no standard error", name, values.size()));
  if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
    throw StateError(fmt::format("{}: a value of the window is not finite", name));

  SteadyValue result;
  result.name = name;
  result.unit = unit;
  result.mean = mean_of(values);
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  result.minimum = *low;
  result.maximum = *high;
  const auto n = static_cast<double>(values.size());
  double squares = 0.0;
  for (const double value : values) squares += (value - result.mean) * (value - result.mean);
  result.deviation = std::sqrt(squares / (n - 1.0));

  const Blocking blocking = block_average(values);
  result.standard_error = blocking.standard_error;
  result.blocks = blocking.blocks;
  result.block_duration = spacing * static_cast<double>(blocking.block_length);
  const double inefficiency =
      squares > 0.0 ? n * (n - 1.0) / squares * result.standard_error * result.standard_error : 1.0;
  result.independent_samples = n / inefficiency;
  result.correlation_time = 0.5 * inefficiency * spacing;

  // a straight line through values with error e of their mean: its change over the window has the
  // error sqrt(12) e, the difference of the halves 2 e
  const double slope = slope_of(values), middle = 0.5 * (n - 1.0);
  std::vector<double> detrended = values;
  for (std::size_t i = 0; i < detrended.size(); ++i)
    detrended[i] -= slope * (static_cast<double>(i) - middle);
  const Blocking residual = block_average(detrended);
  result.drift = slope * (n - 1.0);
  result.drift_error = std::sqrt(12.0) * residual.standard_error;
  result.halves_difference = half_difference(values);
  result.halves_error = 2.0 * residual.standard_error;

  if (is_constant(values, reference)) {
    result.standard_error = 0.0;
    result.steady = true;
    result.verdict = "steady";
    return result;
  }
  const double negligible =
      criteria.negligible_drift * std::max({reference, std::abs(result.mean), result.deviation});
  const double certain = student_t99(std::max(3.0, static_cast<double>(residual.blocks) - 2.0));
  std::string reason;
  const auto add = [&](const std::string& text) { reason += (reason.empty() ? "" : "; ") + text; };
  if (std::abs(result.drift) > negligible && std::abs(result.drift) > certain * result.drift_error)
    add(fmt::format("it drifts by {:.3g} +- {:.2g} {} over the window", result.drift,
                    result.drift_error, unit));
  if (std::abs(result.halves_difference) > negligible &&
      std::abs(result.halves_difference) > certain * result.halves_error)
    add(fmt::format("its halves differ by {:.3g} +- {:.2g} {}", result.halves_difference,
                    result.halves_error, unit));
  const double known = criteria.known_mean * std::max(reference, std::abs(result.mean));
  const double departure = std::max(result.maximum - result.mean, result.mean - result.minimum);
  if (residual.blocks < criteria.min_blocks && departure > 0.5 * known &&
      student_t95(residual.blocks) * result.standard_error > known)
    add(
        fmt::format("the window is too short: its fluctuations last so long that it has only {} "
                    "independent stretches, {} are needed",
                    residual.blocks, criteria.min_blocks));
  result.steady = reason.empty();
  result.verdict = result.steady ? "steady" : "not steady: " + reason;
  return result;
}

}  // namespace furrow
