// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Parameters of a tyre of shells and bricks, as its files (io/inputs/brick_tyre_file.h) give them.
///
/// Half of the section is given, the other half is its mirror image. A is the axial coordinate,
/// outwards from the mid-plane, R the radius about the axle, and s the length along the carcass's
/// outline from the mid-plane on, all stress-free.

#include <algorithm>
#include <string>
#include <vector>

#include "furrow/shell/shell_section.h"
#include "furrow/solid/brick8.h"
#include "furrow/tyre/tyre_parameters.h"

namespace furrow {

/// A stretch of the carcass; 1 is the circumference, 2 the meridian.
struct CarcassZone {
  double end = 0.0;  ///< s [m]; the last one ends at the bead
  OrthotropicWall wall;
  double areal_mass = 0.0;  ///< [kg/m^2]
};

/// Shells from bead to bead: body plies, belts and the rubber between.
struct CarcassParameters {
  std::vector<double> axial, radius;  ///< [m] points of the outline, from the mid-plane to the bead
  std::vector<CarcassZone> zones;     ///< from the mid-plane on
  /// The shells' axes follow the meridian: Shell4Turning::first_median
  bool cords = false;
};

/// A void of the tread: a groove all round, or the gaps between bars of one pitch.
struct TreadVoid {
  double from = 0.0, to = 0.0;  ///< s [m]
  double depth = 0.0;           ///< [m]
  int pitches = 0;              ///< gaps round the tyre; 0: a groove all round
  double share = 1.0;           ///< of the pitch that is cut away
};

/// Rubber on the carcass, normal to it.
struct TreadCapParameters {
  std::vector<double> at;  ///< s [m] from 0 to where the tread ends
  std::vector<double>
      thickness;       ///< [m] at these places, linear between them; 0 at the end makes a wedge
  int layers = 1;      ///< layers of bricks below the voids
  int rib_layers = 1;  ///< next to the voids
  Rubber rubber;
  std::vector<TreadVoid> voids;

  double thickness_at(double s) const;  ///< [m]
  double depth_at(double s) const;      ///< [m] of the voids; straight between them
  double end() const { return at.back(); }
  /// [m] size of the narrowest void, across or along the tyre; a wider object bridges it. Infinite
  /// without voids. @param radius of the tread [m]
  double narrowest_void(double radius) const;
  /// Width of the narrowest rib between grooves, or along a bar [m]; infinite without voids.
  double narrowest_rib(double radius) const;
};

struct BrickTyreParameters {
  std::string title;
  double pressure = 0.0;  ///< [Pa] inflation above the atmosphere
  CarcassParameters carcass;
  TreadCapParameters tread;

  double bead_radius() const { return carcass.radius.back(); }        ///< [m]
  double bead_spacing() const { return 2.0 * carcass.axial.back(); }  ///< [m]
  double radius() const {                                             ///< [m] of the tread
    return carcass.radius.front() + tread.thickness.front();
  }
  double width() const {  ///< [m] of the carcass
    return 2.0 * *std::max_element(carcass.axial.begin(), carcass.axial.end());
  }
};

/// Values of s, from 0 to the bead, at which zones, voids and the tread's thickness change: nodes
/// of every mesh. @param length [m] of the outline
std::vector<double> places_of_change(const BrickTyreParameters& tyre, double length);
/// [m] places closer than this count as one
constexpr double same_place = 1e-4;

/// A warning about shells with polar axes whose tension exceeds their shear stiffness (Shell4)
/// where the outline is widest; empty without such shells. There, by the balance along the axle,
/// the circumference carries no tension and the meridian the pressure times its radius of
/// curvature.
std::string wrinkling(const BrickTyreParameters& tyre);

/// Checks values separately and together.
/// @param where names the tyre in errors
/// @throws InputError
void check(const BrickTyreParameters& tyre, const std::string& where = "tyre");

}  // namespace furrow
