// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The results of a wheel run, from its history. All programs compute them here.

#include <string>
#include <vector>

#include "furrow/statistics/resistance_parts.h"
#include "furrow/statistics/steady_state.h"

namespace furrow {

/// Scales of the results (SteadyCriteria). The steady verdict takes a value below its scale as of
/// this size. With the negligible drift of 2 % a slip may thus drift by 0.02. A force or
/// coefficient may drift by 0.5 % of the load, a torque by that times the radius. This is half of
/// the scatter of careful tests ([Pavlov2024], [Shoop2001]) or less. A depth may drift by 0.2 % of
/// the radius.
constexpr double slip_scale = 1.0;
constexpr double coefficient_scale = 0.25;  ///< of force_z, or of force_z times radius
constexpr double depth_scale = 0.1;         ///< of the radius

struct ResistanceOptions {
  WindowRequest window;
  SteadyCriteria criteria;
  /// travel [m] below which the window is too short: at least a contact length
  double shortest_distance = 0.0;
};

/// Steady values of a wheel run over one window.
struct Resistance {
  Window window;
  /// hub_drop [m], of a tyre also tyre_deflection and rut_depth [m]; force_z [N],
  /// resistance_coefficient, drawbar_pull [N], net_traction_coefficient, drive_torque [N m], slip;
  /// where the history has them also tractive_force and lateral_force [N], overturning_moment and
  /// aligning_moment [N m]. The last three count for the verdict if the lateral force exceeds 2 %
  /// of force_z; without slip angle and camber they are noise. If the heading is not the travel,
  /// also force_x and force_y [N]. The tractive force and these repeat other values, and do not
  /// count
  std::vector<SteadyValue> values;
  ResistanceParts parts;
  bool driven = false;     ///< an axle torque drives or brakes the wheel: it is not towed
  bool axle_free = false;  ///< along x, alone or with the other wheels of a vehicle
  bool steady = false;     ///< the window is good and every value is steady
  /// reasons why it is not steady: "hub drop, slip: it drifts by ..."; empty for a steady run
  std::vector<std::string> reasons;

  bool has(const std::string& name) const;
  const SteadyValue& value(const std::string& name) const;  ///< @throws Error for an unknown name
  /// net_traction_coefficient of a driven wheel, resistance_coefficient of a towed one
  const SteadyValue& coefficient() const;
  /// Value that the run was made for: the coefficient, or the slip of a free axle.
  const SteadyValue& answer() const;
};

/// Name of a value as people read it: "hub drop".
std::string plain_name(const std::string& name);

/// Ratio of the means of two series, r = sum a / sum b, with the error of its linearisation: the
/// series r + (a_i - r b_i)/mean(b) has the mean r, and its blocks carry the correlation of a and
/// b.
/// @throws Error when the lengths differ, StateError when the mean of b is zero
std::vector<double> linearised_ratio(const std::vector<double>& a, const std::vector<double>& b);

/// Needs the channels time, x, hub_drop, force_x, force_z, drawbar_pull, drive_torque, slip
/// (rig/wheel_rig.h) in equally spaced rows; stage if there is one. resistance_coefficient =
/// -force_x/force_z and net_traction_coefficient = drawbar_pull/force_z, ratios of means. The first
/// is for a towed wheel, the second for a driven one. In a steady run drawbar pull and force_x
/// agree; the first is the reading of a load cell between vehicle and wheel, inertia included. A
/// negligible change is relative to the value or to the scales above, whichever is larger; the
/// radius follows from the channels rim_speed and spin_rate. Imposed are a constant slip or torque,
/// and the pull of a wheel that is free along x, which slope and drawbar load set. A wheel that is
/// free along x and makes no progress (free_travel.h) has no averages, unless the window is given.
/// @throws StateError for such a wheel, Error for a missing channel, a history that ends before the
/// cruise, or rows that are missing
Resistance measure_resistance(const History& history, const ResistanceOptions& options = {});

/// The values over equal stretches of the cruise: a curve of a run whose targets change slowly. The
/// standard errors are those of the values less their trend; the verdicts have no meaning here.
/// @throws as measure_resistance()
std::vector<Resistance> measure_curve(const History& history, int stretches);

}  // namespace furrow
