// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The numbers a run is made for, from its history. The only place where they are computed.

#include <string>
#include <vector>

#include "statistics/resistance_parts.h"
#include "statistics/steady_state.h"

namespace furrow {

/// Scales of the answers: a value that is smaller is judged as one of this size (SteadyCriteria),
/// so that no change is one of 0.02 in slip, 2 % of the speed; of 0.5 % of the load in a force or
/// coefficient, in a torque or moment of load times radius, half of what careful tests scatter by
/// (0.01 to 0.02, [Pavlov2024], [Shoop2001]) or less; of 0.2 % of the radius in a depth.
constexpr double slip_scale = 1.0;
constexpr double coefficient_scale = 0.25;  ///< of force_z, or of force_z times radius
constexpr double depth_scale = 0.1;         ///< of the radius

struct ResistanceOptions {
  WindowRequest window;
  SteadyCriteria criteria;
  /// [m] travel below which the window is too short: at least a contact length
  double shortest_distance = 0.0;
};

/// Steady values of a wheel run over one window.
struct Resistance {
  Window window;
  /// hub_drop [m], of a tyre also tyre_deflection and rut_depth [m]; force_z [N],
  /// resistance_coefficient, drawbar_pull [N], net_traction_coefficient, drive_torque [N m], slip;
  /// where the history has them also lateral_force [N],
  /// overturning_moment and aligning_moment [N m], which count for the verdict where the lateral
  /// force is more than 2 % of force_z: of a wheel without slip angle and camber they are noise
  std::vector<SteadyValue> values;
  ResistanceParts parts;
  bool driven = false;  ///< an axle torque drives or brakes the wheel: it is not towed
  bool steady = false;  ///< the window is good and every value is steady
  std::string verdict;  ///< "steady", or "not steady: " and what is not, and why

  bool has(const std::string& name) const;
  const SteadyValue& value(const std::string& name) const;  ///< @throws Error for an unknown name
};

/// Ratio of the means of two series, r = sum a / sum b, with the error of its linearisation: the
/// series r + (a_i - r b_i)/mean(b) has the mean r, and its blocks carry the correlation of a and
/// b.
/// @throws Error when the lengths differ, StateError when the mean of b is zero
std::vector<double> linearised_ratio(const std::vector<double>& a, const std::vector<double>& b);

/// Needs the channels time, x, hub_drop, force_x, force_z, drawbar_pull, drive_torque, slip
/// (rig/wheel_rig.h) in equally spaced rows; stage if there is one. resistance_coefficient =
/// -force_x/force_z and net_traction_coefficient = drawbar_pull/force_z, ratios of means. The first
/// is for a towed wheel, the second for a driven one. In a steady
/// run drawbar pull and force_x agree; the first is what a load cell between vehicle and wheel
/// sees, inertia included. What counts as no change is measured against the value itself, and at
/// least against the scales above; the radius is that of the channels rim_speed and spin_rate. Of a
/// wheel that is free along x and does not get anywhere (free_travel.h) nothing is averaged, unless
/// the window is given.
/// @throws StateError for such a wheel, Error for a missing channel, a history that ends before the
/// cruise, or rows that are missing
Resistance measure_resistance(const History& history, const ResistanceOptions& options = {});

}  // namespace furrow
