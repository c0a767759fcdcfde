// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The times of a rig that rolls several times in the same rut.

#include <algorithm>
#include <cmath>

#include "furrow/rig/ramp.h"

namespace furrow {

/// A pass consists of the stages settle, accelerate and cruise, then the way back. Each pass uses
/// the clock of the first. The last pass stays in its cruise.
class PassSchedule {
 public:
  PassSchedule() = default;
  /// @param first_start of the first settling [s]; @param rolling time from there to the end of the
  /// cruise, @param back time of the way back [s]
  PassSchedule(int passes, double first_start, double rolling, double back)
      : passes_(passes), first_start_(first_start), rolling_(rolling), back_(back) {}

  int passes() const { return passes_; }
  /// Number of the pass; 0 for the first.
  int index(double time) const {
    if (passes_ == 1) return 0;
    const double number = std::floor((time - first_start_) / (rolling_ + back_));
    return static_cast<int>(std::clamp(number, 0.0, passes_ - 1.0));
  }
  /// Delay of the pass at a time against the clock of the first pass [s].
  double delay(double time) const { return index(time) * (rolling_ + back_); }
  /// True while the wheel returns or is lowered into the rut. @param time on the first's clock
  bool goes_back(double time, int index) const {
    return index + 1 < passes_ && time >= rolling_end();
  }
  double rolling_end() const { return first_start_ + rolling_; }  ///< on the first's clock [s]
  /// Thirds of the way back, on the first's clock.
  Ramp lifting() const { return {rolling_end(), back_ / 3.0}; }
  Ramp returning() const { return {rolling_end() + back_ / 3.0, back_ / 3.0}; }
  Ramp lowering() const { return {rolling_end() + 2.0 * back_ / 3.0, back_ / 3.0}; }

 private:
  int passes_ = 1;
  double first_start_ = 0.0, rolling_ = 0.0, back_ = 0.0;  // [s]
};

/// Share of a velocity that remains after the step [time, time + dt] of a ramp in which it fades to
/// 0.
inline double fading(const Ramp& ramp, double time, double dt) {
  const double left = 1.0 - ramp.value(time);
  return left > 0.0 ? (1.0 - ramp.value(time + dt)) / left : 0.0;
}

/// Velocity over the step [time, time + dt] that brings a position to a target as the ramp rises.
/// It depends on the present position only, so a restart needs no other state.
inline double approach(const Ramp& ramp, double position, double target, double time, double dt) {
  const double left = 1.0 - ramp.value(time);
  if (!(left > 0.0)) return 0.0;
  return (target - position) * (ramp.value(time + dt) - ramp.value(time)) / (left * dt);
}

}  // namespace furrow
