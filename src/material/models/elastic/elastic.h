// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Elastic ground: linear or porous elasticity (elasticity.h) without yielding. Rate form
/// (hypoelastic) under finite strain.

#include "material/material_model.h"
#include "material/models/elastic/elastic_parameters.h"

namespace furrow {

class Elastic : public Material {
 public:
  static MaterialModel model();
  /// @param density  rho0 [kg/m^3]
  Elastic(double density, const ElasticParameters& parameters);

  UpdateReport update_block(const PointBlock& block) const override;
  ElasticModuli moduli(const VectorX& state) const override;
  double largest_wave_speed(const PointBlock& block) const override;

 private:
  ElasticParameters parameters_;
};

}  // namespace furrow
