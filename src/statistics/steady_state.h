// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The steady part of a history: where it begins, the mean with its standard error, and whether it
/// is steady at all (theory: errors, eqs. 1 to 5).

#include <optional>
#include <string>
#include <vector>

#include "furrow/statistics/history.h"

namespace furrow {

/// Window that the user requests. The default is the cruise without its transient.
struct WindowRequest {
  std::optional<double> from_time, to_time;          ///< [s]
  std::optional<double> from_distance, to_distance;  ///< [m] travelled along x since the first row
  bool whole_pitches =
      false;  ///< true: a given window begins later, to cover whole pitches of grousers

  bool given() const { return from_time || to_time || from_distance || to_distance; }
};

/// Rows [first, last) of a history.
struct Window {
  std::size_t first = 0, last = 0;
  double begin = 0.0, end = 0.0;  ///< [s] of the first and the last row
  double distance = 0.0;          ///< [m] travelled along x in it
  bool automatic = false;         ///< the begin was determined, not given
  /// choice in words: "cruise from 2.1 s, transient of 0.31 s left out (MSER-5)"
  std::string how;
  std::string warning;  ///< empty, or why the begin is in doubt

  std::size_t rows() const { return last - first; }
};

/// First row of the cruise; 0 for a history without stages. @throws Error when it ends before
std::size_t first_row_of_cruise(const History& history);

/// MSER-5 [White1997]: the truncation that minimises theory: errors, eq. 1, with means of five
/// values. If scatter explains several minima, the earliest counts; otherwise a calm end would turn
/// everything before it into a transient.
/// @return how many values to leave out, at most the first half of the series
std::size_t mser_truncation(const std::vector<double>& values);

/// Selects the rows of the window. Automatic: from the start of the cruise (channel `stage`,
/// rig_stage.h; the first row without such a channel), less the longest transient of the named
/// channels. If the wheel has grousers (channel `grouser_pitches`), the window then begins later,
/// so that it covers whole pitches to half a row.
/// @throws InputError for a request outside of the history, or one given by both time and distance;
/// Error when no rows remain
Window select_window(const History& history, const WindowRequest& request,
                     const std::vector<std::string>& channels);

/// Limits of the verdict.
struct SteadyCriteria {
  /// negligible change over the window, as a share of the reference: it counts as steady even if it
  /// is significant
  double negligible_drift = 0.02;
  /// least number of independent blocks for a verdict, about 40 correlation times
  std::size_t min_blocks = 6;
  /// share of the reference within which the mean counts as known: its 95 % interval by Student's t
  /// is within it, or no value departs from the mean by more than half of it
  double known_mean = 0.02;
};

/// Mean of a quantity over a window, with errors and verdict.
struct SteadyValue {
  std::string name, unit;
  double mean = 0.0;
  double standard_error = 0.0;  ///< of the mean, from the blocks
  double deviation = 0.0;       ///< standard deviation of the rows
  double minimum = 0.0, maximum = 0.0;
  /// [s] integrated autocorrelation time; half a row spacing for uncorrelated rows
  double correlation_time = 0.0;
  double independent_samples = 0.0;  ///< deviation^2/standard_error^2
  std::size_t blocks = 0;            ///< number of blocks with uncorrelated means
  double block_duration = 0.0;       ///< [s]
  double drift = 0.0;                ///< change over the window by a straight line
  double drift_error = 0.0;          ///< its standard error
  double halves_difference = 0.0;    ///< mean of the second half minus mean of the first
  double halves_error = 0.0;         ///< its standard error
  bool steady = false;
  bool imposed = false;  ///< an input of the run: its value is that of the scene, without an error
  std::string verdict;   ///< "steady", or "not steady: " and why
};

/// Mean, error and verdict of equally spaced values.
///
/// Standard error: theory: errors, eqs. 2 and 3; 0 where the values differ by rounding alone. The
/// remaining bias is about -tau/(2 length).
/// Steady: neither the straight line nor the two halves differ from a constant by more than the
/// negligible drift, at 99 % by Student's t. The errors are those of the detrended values (eq. 5).
/// In addition there are enough blocks, or the mean is well known with few, or all values are
/// nearly the same.
/// @param spacing of the rows [s]
/// @param reference scale of a negligible drift; the larger of it, |mean| and the deviation counts
/// @throws Error for fewer than two values, StateError for values that are not finite
SteadyValue analyse_steady(const std::string& name, const std::string& unit,
                           const std::vector<double>& values, double spacing,
                           double reference = 0.0, const SteadyCriteria& criteria = {});

}  // namespace furrow
