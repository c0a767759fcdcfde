// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// How long ground has to be that moves along with a wheel.

namespace furrow {

/// On either side of the axle as far as a wheel that has sunk to the base cuts the surface, and on
/// by the depth: over a base that holds, the stress of a load fades within the depth of the layer.
/// Rounded up to two digits, so that it does not depend on the cells.
/// @param radius  of the wheel [m]; @param depth  of the ground [m]
/// @return [m]
double length_under_wheel(double radius, double depth);

}  // namespace furrow
