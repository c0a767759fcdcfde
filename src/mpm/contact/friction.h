// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The largest tangential force of a contact.

#include <algorithm>
#include <cmath>
#include <limits>

namespace furrow {

/// Coulomb's law up to a shear stress, mobilised with the slip j (theory: contact, eq. 5;
/// [Shoop2001] eq 26).
struct Friction {
  double coefficient;                                            ///< mu
  double slip_length;                                            ///< k [m]; 0: fully mobilised
  double shear_limit = std::numeric_limits<double>::infinity();  ///< adhesion [Pa]

  bool mobilised_by_slip() const { return slip_length > 0.0; }
  /// @param normal_force  [N], pressure positive; @param slip  [m]; @param area  of the contact
  /// [m^2]; @return [N]
  double limit(double normal_force, double slip, double area) const {
    if (normal_force <= 0.0 || coefficient == 0.0) return 0.0;
    const double mobilised = mobilised_by_slip() ? -std::expm1(-slip / slip_length) : 1.0;
    return std::min(coefficient * normal_force, shear_limit * area) * mobilised;
  }
};

}  // namespace furrow
