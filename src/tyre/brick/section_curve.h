// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The outline of half a tyre's section as a smooth curve.

#include <vector>

#include "furrow/core/types.h"

namespace furrow {

/// The cubic spline through points (A, R) from the mid-plane to the bead, level at its beginning
/// and straight at its end, by its arc length s.
class SectionCurve {
 public:
  /// @param axial, radius of the points [m]; as many, three at least, none twice in a row
  SectionCurve(const std::vector<double>& axial, const std::vector<double>& radius);

  double length() const { return arc_.back(); }  ///< [m]
  Vector2 point(double s) const;                 ///< A, R [m]
  Vector2 normal(double s) const;                ///< unit, away from the air inside

 private:
  double parameter(double s) const;
  Vector2 value(double t, Vector2* derivative) const;

  std::vector<double> t_;  // chord length at the points [m]
  Eigen::Matrix2Xd points_, second_;
  std::vector<double> sample_, arc_;  // parameter [m] and arc length [m], close together
};

}  // namespace furrow
