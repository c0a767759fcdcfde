// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Length and width of ground that moves along with a wheel, and the width of its fine part.

namespace furrow {

struct GroundSize {
  double length = 0.0;      ///< [m] along the travel
  double width = 0.0;       ///< [m] across it
  double fine_width = 0.0;  ///< [m] part of the width that needs fine cells
};

/// Size along the travel: on either side of the axle, half the chord at which a wheel that has sunk
/// to the base cuts the surface, plus the depth. Size across it: the wheel plus the depth on either
/// side; the fine part has a quarter of that depth. Over a base that holds, the stress of a load
/// fades within the depth of the
/// layer. All are rounded up to two digits, so that they do not depend on the cells.
/// @param radius, width  of the wheel [m]; @param depth  of the ground [m]
GroundSize ground_under_wheel(double radius, double width, double depth);

/// A length [m] up to two digits, as a remedy names it.
double rounded_up(double value);

}  // namespace furrow
