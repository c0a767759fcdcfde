// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Bekker's and Janosi's parameters of a soil (theory: scm, eqs. 1 and 4).

#include "core/options.h"

namespace furrow {

/// Pressure p = (kc/b + kphi) z^n; shear stress (cohesion + p tan(friction_angle)) (1 - exp(-j/K)).
struct Soil {
  double kc = 0.0;              ///< [N/m^(n+1)]
  double kphi = 0.0;            ///< [N/m^(n+2)]
  double n = 1.0;               ///< exponent of the sinkage
  double cohesion = 0.0;        ///< [Pa]
  double friction_angle = 0.0;  ///< [rad]
  double shear_length = 0.01;   ///< K [m]
  double stiffness = 1e8;       ///< [Pa/m] pressure per elastic sinkage
  double damping = 0.0;         ///< [Pa s/m] pressure per velocity of the sinkage
  double flow = 0.0;            ///< share of the displaced volume that moves to the sides

  /// [Pa/m^n] under a contact of this width [m]. @throws StateError unless it is positive
  double modulus(double width) const;
};

/// The keys of a soil; angles in degrees.
void declare_soil(Schema& schema);
Soil soil_from(const Options& options);
/// @throws InputError for values out of range @param where names the soil
void check(const Soil& soil, const std::string& where);

}  // namespace furrow
