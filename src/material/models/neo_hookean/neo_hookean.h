// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Rubber: compressible neo-Hookean solid, [Simo1998] section 9.2. Stress: theory: laws, eq. 5.
/// Energy per reference volume:
///   W = (mu/2)(J^(-2/3) tr b - 3) + (K/4)(J^2 - 1 - 2 ln J)
/// The state is the left Cauchy-Green tensor b. The stress follows from it, so setting the stress
/// alone has no effect.

#include "furrow/material/kernel_law.h"
#include "furrow/material/models/neo_hookean/neo_hookean_parameters.h"

namespace furrow {

class NeoHookean : public KernelLaw<NeoHookeanParameters, NeoHookeanKernels> {
 public:
  enum : std::size_t { b_minus_identity = field::internal };  ///< six fields xx, yy, zz, xy, yz, xz

  static MaterialModel model();
  /// @param density  rho0 [kg/m^3]
  NeoHookean(double density, const NeoHookeanParameters& parameters);

  /// A bound: the small-strain moduli, raised by the stretch of the state.
  ElasticModuli moduli(const VectorX& state) const override;
};

}  // namespace furrow
