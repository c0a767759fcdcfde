// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Length, width and cells of ground that moves along with a wheel, from the wheel and the depth.

#include <limits>
#include <optional>

#include "furrow/bodies/wheel_hub.h"
#include "furrow/mpm/ground/boundary_effect.h"

namespace furrow {

struct GroundSize {
  double length = 0.0;       ///< [m] along the travel
  double width = 0.0;        ///< [m] across it
  double fine_width = 0.0;   ///< [m] part of the width that needs fine cells
  double cell = 0.0;         ///< [m] edge of fine cells; 0: not chosen
  double fine_depth = 0.0;   ///< [m] whole fine cells below the surface; 0: all of the depth
  const char* cell_by = "";  ///< reason of the cell, for a message
};

/// Size along the travel: on either side of the axle, half the chord at which a wheel that has sunk
/// to the base cuts the surface, plus the depth. Size across it: the wheel plus the depth on either
/// side; the fine part has a quarter of that depth. Over a base that holds, the stress of a load
/// fades within the depth of the
/// layer. All are rounded up to two digits, so that they do not depend on the cells.
/// @param radius, width  of the wheel [m]; @param depth  of the ground [m]
GroundSize ground_under_wheel(double radius, double width, double depth);

/// Cells in height and spacing of grousers, from which the ground resolves them.
constexpr double cells_of_a_grouser = 2.5;

/// Lengths of a wheel that cells must resolve [m]; infinite where it has none.
struct WheelDetails {
  static constexpr double none = std::numeric_limits<double>::infinity();
  double radius = none;
  double width = none;
  double groove = none;  ///< narrowest groove or rib of a tread
  double grouser_height = none;
  double grouser_spacing = none;
};
WheelDetails details_of(const WheelHub& wheel);

/// Sets the cell, rounded down to two digits, and the depth of fine cells.
/// @param depth  of the ground [m]
/// @param thin_parts  true: ground before and behind a grouser moves apart
void choose_cell(GroundSize& size, const WheelDetails& wheel, double depth, bool thin_parts);

/// Standard errors of a driven smooth rigid wheel in cells of an eighth of its width, or less:
/// those of inputs/validation/sizes.csv and scheme.csv, which a test compares.
struct CellError {
  double hub_drop;  ///< over the hub drop
  double pull;      ///< net traction over the load
};
/// None for clay, on which no wheel has been computed in several cells.
std::optional<CellError> cell_error(GroundKind kind);

/// A length [m] up to two digits, as a remedy names it.
double rounded_up(double value);

}  // namespace furrow
