// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Saturated clay under quick loads: the strength does not depend on the pressure.
///
///   q <= 2 c_u,  q = sqrt(3/2 s : s),  s = dev(sigma)
///
/// The trial stress is elastic. The radial return scales its deviator s to the strength. c_u is the
/// undrained shear strength [Pa]: half the deviator stress in triaxial compression.

#include "furrow/material/material_model.h"
#include "furrow/material/pointwise_material.h"

namespace furrow {

class VonMises : public PointwiseMaterial {
 public:
  static MaterialModel model();
  VonMises(double density, const ElasticModuli& moduli, double c_u);

  ElasticModuli moduli(const VectorX&) const override { return moduli_; }
  double yield_function(const VectorX& state) const override;
  double stress_scale(const VectorX& state) const override;
  std::vector<Vector2> yield_surface(const VectorX& state, std::size_t points) const override;

 private:
  void step(PointStep& point) const override;

  ElasticModuli moduli_;
  double largest_q_;  // 2 c_u [Pa]
};

}  // namespace furrow
