// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Dynamic relaxation with kinetic damping (P. A. Cundall 1976; M. R. Barnes 1999): a structure
/// moves without damping until its kinetic energy has passed a peak, where the potential energy is
/// lowest; then all motion is stopped and it starts again.

#include <cstddef>

namespace furrow {

class KineticDamping {
 public:
  /// @param energy kinetic energy after a step [J]
  /// @returns true when motion should be stopped now
  bool peaked(double energy) {
    const bool falling = energy < last_;
    last_ = falling ? 0.0 : energy;
    stops_ += falling;
    return falling;
  }
  std::size_t stops() const { return stops_; }

 private:
  double last_ = 0.0;
  std::size_t stops_ = 0;
};

/// What a relaxation came to.
struct Relaxation {
  long steps = 0;
  std::size_t stops = 0;
  double residual = 0.0;  ///< largest unbalanced force over the force scale
  bool converged = false;
};

}  // namespace furrow
