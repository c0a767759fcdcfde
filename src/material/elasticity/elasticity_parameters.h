// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Constants of the elastic part of a law, as plain data for the kernels.

namespace furrow {

struct ElasticityParameters {
  bool porous = false;
  double bulk = 0.0;         ///< K [Pa], linear
  double shear = 0.0;        ///< G [Pa], linear; porous with constant shear modulus
  double shear_ratio = 0.0;  ///< G/K, porous with constant Poisson's ratio; 0 when G is constant
  double stiffness = 0.0;    ///< (1 + e0)/kappa, porous
  double p0 = 0.0;           ///< pressure at which J_el = 1 [Pa], porous
  double limit = 0.0;        ///< tensile limit p_t,el [Pa], porous
  double resolution = 0.0;   ///< least p + limit, below which a stress is rounding [Pa], porous
};

}  // namespace furrow
