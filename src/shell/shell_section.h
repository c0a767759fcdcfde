// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Stiffness of a shell per unit of its width. An element integrates it over its area instead of a
/// material over the thickness.

#include "furrow/core/types.h"

namespace furrow {

/// A layer with fibres: 1 along them, 2 across in the layer, 3 through it.
struct OrthotropicLayer {
  double E1 = 0.0, E2 = 0.0;    ///< [Pa]
  double nu12 = 0.0;            ///< [-] strain along 2 for stress along 1: nu12/E1 = nu21/E2
  double G12 = 0.0;             ///< [Pa]
  double G13 = 0.0, G23 = 0.0;  ///< [Pa] transverse shear
  double thickness = 0.0;       ///< h [m]

  static OrthotropicLayer isotropic(double E, double nu, double thickness);
};

/// A wall of cords in rubber, whose bending does not follow from its stretching: per unit of width,
/// 1 and 2 without Poisson's coupling.
struct OrthotropicWall {
  double stretch1 = 0.0, stretch2 = 0.0;  ///< [N/m]
  double shear = 0.0;  ///< [N/m] shear stiffness in the wall; transverse shear has 5/6 of it
  double bending1 = 0.0, bending2 = 0.0;  ///< [N m]; twist sqrt(bending1 bending2)/2
};

/// Resultants of a plate in its material axes: N = A eps, M = D kappa, Q = S gamma, engineering
/// shears.
struct ShellSection {
  Matrix3 membrane = Matrix3::Zero();               ///< A [N/m]
  Matrix3 bending = Matrix3::Zero();                ///< D [N m]
  Eigen::Matrix2d shear = Eigen::Matrix2d::Zero();  ///< S [N/m], 5/6 G h
  double thickness = 0.0;                           ///< [m] for the least rotary inertia
  double areal_mass = 0.0;                          ///< [kg/m^2]

  /// A = h Q, D = h^3/12 Q with the plane-stress Q of the layer.
  /// @throws InputError for a layer that is not positive definite or a mass that is not positive
  ShellSection(const OrthotropicLayer& layer, double areal_mass);
  /// @throws InputError for a stiffness or a mass that is not positive
  ShellSection(const OrthotropicWall& wall, double areal_mass);
};

}  // namespace furrow
