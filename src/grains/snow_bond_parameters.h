// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The parameters of the contact law of sintered snow clusters (snow_bond.h), and their keys.

#include "furrow/core/options/options.h"

namespace furrow {

/// Stresses are forces over the squared diameter of a contact, so the law is the same for clusters
/// of any size. The defaults are fresh snow of 200 kg/m3: the ground snow_bonded of
/// inputs/laboratory.
struct SnowBondParameters {
  double E = 2e7;        ///< [Pa] stiffness of a contact over its diameter
  double Y0 = 1.15e3;    ///< [Pa] crush strength of a fresh bond
  double p = 3.0;        ///< its growth with the crushing X
  double Y1 = 5.6;       ///< [Pa] crush strength of dense snow ...
  double q = 27.0;       ///< ... and its growth with X
  double pc = 13.0;      ///< growth of the strength of a bond with X
  double chi = 0.7;      ///< shear strength of a bond over its crush strength
  double zeta = 1.0;     ///< tensile strength of a bond over its crush strength
  double mu = 0.3;       ///< coefficient of friction
  double w = 0.5;        ///< share of the crushed area that becomes bond
  double damping = 0.2;  ///< of elastic motion along the normal, of critical

  /// The keys, which are the names of properties in LIGGGHTS.
  static Schema schema();
  static SnowBondParameters from(const Options& options);
};

}  // namespace furrow
