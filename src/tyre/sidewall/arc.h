// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The circular arc of a given length over a given chord.

#include "furrow/core/types.h"

namespace furrow {

/// Half of the angle between the arc's ends as seen from its centre, alpha: sin(alpha)/alpha =
/// share.
/// @param share chord over length, in (0, 1]; from 1 on alpha is 0
/// @returns alpha in [0, pi) [rad]
double arc_half_angle(double share);

class Arc {
 public:
  /// @param from, to its ends [m]
  /// @param length [m] that of the chord at least, or the chord is taken
  /// @param outwards direction of the bulge; its part normal to the chord counts
  Arc(const Vector3& from, const Vector3& to, double length, const Vector3& outwards);

  /// @param share of the length from the first end
  Vector3 point(double share) const;

 private:
  Vector3 from_;
  Vector3 along_;  // unit vectors along the chord and outwards
  Vector3 outwards_;
  double chord_;   // [m]
  double alpha_;   // [rad]
  double radius_;  // [m]; 0 where the arc is nearly straight
};

}  // namespace furrow
