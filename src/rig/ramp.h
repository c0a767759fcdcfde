// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A smooth change from 0 to 1, for loads and speeds.

#include <algorithm>
#include <cmath>

#include "furrow/core/smooth_step.h"

namespace furrow {

/// S((t - start)/duration) with the S of core/smooth_step.h: value, first and second derivative are
/// continuous. A duration of 0 is a step at start.
struct Ramp {
  double start = 0.0;     ///< [s]
  double duration = 0.0;  ///< [s]

  double end() const { return start + duration; }

  double value(double time) const { return smooth_step(fraction(time)); }

  /// d/dt [1/s]
  double rate(double time) const {
    if (duration <= 0.0) return 0.0;
    const double u = fraction(time);
    return 30.0 * u * u * (1.0 - u) * (1.0 - u) / duration;
  }

  /// Integral of the value from the start to time [s]: duration u^4 (5/2 - 3 u + u^2) on the ramp,
  /// u = (time - start)/duration, and 1 s per second after it.
  double integral(double time) const {
    const double u = fraction(time);
    return duration * u * u * u * u * (2.5 - u * (3.0 - u)) + std::max(0.0, time - end());
  }

  /// Mean of the value over [from, to], to > from. Three-point Gauss quadrature is exact for this
  /// polynomial, also over intervals so short that a difference of integrals would lose digits.
  double mean(double from, double to) const {
    const double finish = std::clamp(end(), from, to);
    return (integrate(&Ramp::value, from, to) + (to - finish)) / (to - from);
  }

  /// Mean of the rate over [from, to] [1/s], computed as mean(); 0 for a step.
  double mean_rate(double from, double to) const {
    return integrate(&Ramp::rate, from, to) / (to - from);
  }

 private:
  /// Integral over the part of [from, to] that lies on the ramp.
  double integrate(double (Ramp::*function)(double) const, double from, double to) const {
    const double begin = std::clamp(start, from, to);
    const double finish = std::clamp(end(), from, to);
    const double half = 0.5 * (finish - begin);
    const double middle = 0.5 * (begin + finish);
    const double offset = std::sqrt(0.6) * half;
    if (half <= 0.0) return 0.0;
    return half / 9.0 *
           (5.0 * (this->*function)(middle - offset) + 8.0 * (this->*function)(middle) +
            5.0 * (this->*function)(middle + offset));
  }

  double fraction(double time) const {
    if (duration <= 0.0) return time < start ? 0.0 : 1.0;
    return std::clamp((time - start) / duration, 0.0, 1.0);
  }
};

}  // namespace furrow
