// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Parameters of a tyre: rim, tread band, sidewalls. Tyre files (io/inputs/tyre_file.h) are read
/// into these.
///
/// Section of the tyre: A is the axial coordinate, outwards from the mid-plane, and R the radius
/// about the axle. Both sidewalls are alike. A sidewall runs from its bead (A = bead_spacing/2, R =
/// bead_radius) to the edge of the tread (A = half_width, R = radius - crown) plus the link, a
/// rigid arm on the tread's edge.

#include <string>
#include <vector>

#include "furrow/core/types.h"

namespace furrow {

/// Pressure [Pa] above that of any tyre (aircraft: 1.5 MPa)
constexpr double largest_inflation = 2e6;

/// A chain of N equal inextensible segments and N - 1 hinges between them, counted from bead to
/// tread. Stiffnesses are per unit width, i.e. per unit circumference of the tread. Angles are
/// those of a segment, from +A (outwards) towards +R (away from the axle): a sidewall leaves the
/// rim near 23 degrees and reaches the tread near 133.
struct SidewallParameters {
  double length = 0.0;          ///< l [m] of the whole chain; a segment has L = l/N
  std::vector<double> bending;  ///< EI [N m] of each hinge, whose stiffness is EI/L; N - 1 values
  /// kappa_0 [1/m] of each hinge, stress-free turn kappa_0 L; N - 1 values
  std::vector<double> curvature;
  /// angle [rad] of the first segment where the rim's spring is free of moment
  double rim_angle = 0.0;
  /// angle [rad] of the last segment where the tread's spring is, relative to the tread
  double tread_angle = 0.0;
  /// stiffness [N m/rad per m] of the spring between rim and first segment; 0: a pin
  double rim_stiffness = 0.0;
  /// stiffness [N m/rad per m] of the spring between last segment and tread; 0: a pin
  double tread_stiffness = 0.0;
  /// Width of the strip that the pressure acts on, over its width at the tread: bead_width + taper
  /// r, r the radial distance from the bead. A strip between two meridians has R_bead/R_tread and
  /// 1/R_tread; an even one 1 and 0.
  double bead_width = 1.0;
  double taper = 0.0;  ///< [1/m]

  std::size_t segments() const { return bending.size() + 1; }
};

/// The band under the tread: an orthotropic shell, 1 along the circumference, 2 across.
struct TreadParameters {
  double radius = 0.0;      ///< [m] of the belts, without pressure
  double half_width = 0.0;  ///< [m]
  double crown = 0.0;       ///< [m] the radius at the edge is smaller by this, along a parabola
  double thickness = 0.0;   ///< h [m] of the equivalent shell: EI = E h^3/12 per unit width
  double E1 = 0.0;          ///< [Pa]
  double E2 = 0.0;          ///< [Pa]
  double nu12 = 0.0;        ///< [-]
  double G12 = 0.0;         ///< [Pa]
  double areal_mass = 0.0;  ///< [kg/m^2] of the real tread, rubber and belts
};

struct TyreParameters {
  std::string title;
  double pressure = 0.0;      ///< [Pa] inflation above the atmosphere
  double bead_radius = 0.0;   ///< [m] R where a sidewall begins
  double bead_spacing = 0.0;  ///< [m] between the two beads
  Vector2 link = Vector2::
      /// [m] axial and radial, from the tread's edge to the sidewall's end: a rigid arm that turns
      /// with the edge
      Zero();
  TreadParameters tread;
  SidewallParameters sidewall;

  /// Chord of a sidewall whose tread edge is where it was made: axial and radial [m].
  Vector2 sidewall_chord() const {
    return {tread.half_width + link[0] - 0.5 * bead_spacing,
            tread.radius - tread.crown + link[1] - bead_radius};
  }
};

/// Refuses values that no tyre has, each one and together: a sidewall stretched past its length, a
/// rim wider than the tyre.
/// @param where names the tyre in errors
/// @throws InputError
void check(const SidewallParameters& sidewall, const std::string& where = "sidewall");
void check(const TyreParameters& tyre, const std::string& where = "tyre");

}  // namespace furrow
