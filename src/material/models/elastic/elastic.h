// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Elastic ground: linear or porous elasticity and nothing else. Rate form (hypoelastic) under
/// finite strain.

#include "material/elasticity/elasticity.h"
#include "material/material.h"
#include "material/registry.h"

namespace furrow {

class Elastic : public Material {
 public:
  static MaterialModel law();
  Elastic(double density, const ElasticityParameters& elasticity);

  UpdateReport update_block(const PointBlock& block) const override;
  ElasticModuli moduli(const VectorX& state) const override;
  double largest_wave_speed(const PointBlock& block) const override;
  double stress_scale(const VectorX& state) const override;

 private:
  ElasticityParameters elasticity_;
};

}  // namespace furrow
