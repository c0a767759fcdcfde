// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Standard linear solid: elastic in volume, a spring beside a Maxwell element in shear.
///
///   s = s_inf + h,   ds_inf/dt = 2 G_inf de/dt,   dh/dt + h/tau = 2 G_1 de/dt,   p from K
/// Steps of constant strain rate are exact: with x = dt/tau
///   h_{n+1} = exp(-x) h_n + 2 G_1 (1 - exp(-x))/x (e_{n+1} - e_n)
/// (R. L. Taylor, K. S. Pister, G. L. Goudreau, Int. J. Numer. Meth. Eng. 2 (1970) 45). Energies:
/// the springs store, the dashpot turns the rest of the work into heat.

#include "furrow/material/material_model.h"
#include "furrow/material/pointwise_material.h"

namespace lab {

struct StandardLinearSolidParameters {
  double bulk = 0.0;             ///< K [Pa]
  double shear_long_term = 0.0;  ///< G_inf [Pa]
  double shear_maxwell = 0.0;    ///< G_1 [Pa]
  double tau = 0.0;              ///< relaxation time [s]
};

class StandardLinearSolid : public furrow::PointwiseMaterial {
 public:
  static furrow::MaterialModel model();
  /// @param density  rho0 [kg/m^3]
  StandardLinearSolid(double density, const StandardLinearSolidParameters& parameters);

  bool rate_dependent() const override { return true; }
  /// Moduli of a sudden step.
  furrow::ElasticModuli moduli(const furrow::VectorX& state) const override;

 private:
  void step(furrow::PointStep& point) const override;

  StandardLinearSolidParameters parameters_;
};

}  // namespace lab
