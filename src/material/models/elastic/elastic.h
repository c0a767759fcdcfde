// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Elastic ground: linear or porous elasticity (elasticity.h) without yielding. Rate form
/// (hypoelastic) under finite strain.

#include "furrow/material/kernel_law.h"
#include "furrow/material/models/elastic/elastic_parameters.h"

namespace furrow {

class Elastic : public ElasticKernelLaw<ElasticParameters, ElasticKernels> {
 public:
  static MaterialModel model();
  /// @param density  rho0 [kg/m^3]
  Elastic(double density, const ElasticParameters& parameters);
};

}  // namespace furrow
