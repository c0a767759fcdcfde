// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Interface of a sidewall: forces, stiffness and potential for a position of the tread edge.
/// SidewallDirect solves the chain, SidewallTable interpolates in a table.
///
/// A sidewall is a planar chain in the meridian plane [Shoop2001], as wide as its strip of the
/// tread. All values are per unit circumference of the tread; a station of the width w multiplies
/// them by w. The pressure acts on the strip's width omega = bead_width + taper r
/// (tyre_parameters.h). An even strip has a constant width; a strip between two meridians is
/// narrower at the rim. Neglected are tension and shear along the circumference, the variation of
/// bending stiffness with the strip's width, and the mass of the sidewall.
///
/// Pressure is a follower load. On the tread act minus the gradient of the potential W and the
/// tread's share of the pressure on the chord (theory: tyres, eq. 4). The force alone has no
/// potential, because dF_a/dr - dF_r/da = p omega(r). W does and can be tabulated; the rest is
/// exact.

#include <cstddef>

#include "furrow/core/types.h"

namespace furrow {

/// Tread end of a sidewall, seen from its bead.
struct SidewallEnd {
  double a = 0.0;  ///< [m] axial, outwards
  double r = 0.0;  ///< [m] radial, away from the axle
  /// [rad] rotation of the tread edge from where it was made, from +a towards +r
  double phi = 0.0;
};

struct SidewallResponse {
  /// -dW/d(a, r, phi): on_tread without the pressure on the chord [N/m], [N/m], [N m/m]
  Vector3 force = Vector3::Zero();
  Vector3 on_tread = Vector3::Zero();  ///< F_a, F_r [N/m], M [N m/m] from +a towards +r
  /// -d(on_tread)/d(a, r, phi); not symmetric in (a, r) by the pressure
  Matrix3 stiffness = Matrix3::Zero();
  double potential = 0.0;  ///< W [J/m]
};

/// An equilibrium in detail, by the chain.
struct SidewallShape {
  Eigen::Matrix2Xd nodes;            ///< [m] from the bead (0, 0) to the end (a, r); N + 1 columns
  VectorX angles;                    ///< of the N segments [rad]
  Vector3 on_rim = Vector3::Zero();  ///< F_a, F_r [N/m], M [N m/m] at the bead
  double bending = 0.0;              ///< energy of hinges and end springs [J/m]
  double area = 0.0;                 ///< S [m^2]: W = bending - p S
};

class Sidewall {
 public:
  virtual ~Sidewall() = default;

  /// Responses of n stations. The direct solution of a station starts from its previous one, so
  /// callers must keep the order of stations.
  /// @param ends, responses n of each; owned by the caller
  /// @param with_stiffness false leaves out the stiffness
  /// @throws StateError for an end that is not finite or cannot be reached, naming the station
  virtual void evaluate(const SidewallEnd* ends, SidewallResponse* responses, std::size_t n,
                        bool with_stiffness) = 0;

  virtual double pressure() const = 0;  ///< [Pa]
  /// Sets the pressure from the next evaluation on; a table is made for it. @throws StateError
  virtual void set_pressure(double pressure) = 0;
  /// Shape by the chain, also if forces come from a table. @throws StateError
  virtual SidewallShape shape(const SidewallEnd& end) = 0;
};

}  // namespace furrow
