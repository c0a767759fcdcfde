// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// How long and how wide ground has to be that moves along with a wheel, and how much of it fine.

namespace furrow {

struct GroundSize {
  double length = 0.0;      ///< [m] along the travel
  double width = 0.0;       ///< [m] across it
  double fine_width = 0.0;  ///< [m] the part of it that needs fine cells
};

/// Along the travel: on either side of the axle as far as a wheel that has sunk to the base cuts
/// the surface, and on by the depth. Across it: the wheel, and on by the depth on either side; fine
/// by a quarter of that. Over a base that holds, the stress of a load fades within the depth of the
/// layer. All are rounded up to two digits, so that they do not depend on the cells.
/// @param radius, width  of the wheel [m]; @param depth  of the ground [m]
GroundSize ground_under_wheel(double radius, double width, double depth);

/// A length [m] up to two digits, as a remedy names it.
double rounded_up(double value);

}  // namespace furrow
