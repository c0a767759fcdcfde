// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Laws whose kernels update as many points as a register holds: parameters as plain data, and the
/// kernels of the run.

#include <string>
#include <utility>
#include <vector>

#include "furrow/material/elasticity/elasticity.h"
#include "furrow/simd/dispatch.h"

namespace furrow {

/// `Kernels` is the table next to `Parameters` (models/elastic is the shortest).
template <class Parameters, class Kernels>
class KernelLaw : public Material {
 public:
  UpdateReport update_block(const PointBlock& block) const final {
    return checked(kernels<Kernels>().update(parameters_, density(), block), block);
  }
  const Parameters& parameters() const { return parameters_; }

 protected:
  KernelLaw(std::string name, double density, const Parameters& parameters,
            const std::vector<StateVariable>& internal_variables, double pressure = 0.0)
      : Material(std::move(name), density, internal_variables, pressure), parameters_(parameters) {}

  Parameters parameters_;
};

/// A law with the section "elasticity": `Parameters` has its values as `elasticity`.
template <class Parameters, class Kernels>
class ElasticKernelLaw : public KernelLaw<Parameters, Kernels> {
 public:
  ElasticModuli moduli(const VectorX& state) const final {
    return moduli_at(this->parameters_.elasticity, invariants(stress_of(state)).p);
  }
  double largest_wave_speed(const PointBlock& block) const final {
    return largest_elastic_wave_speed(this->parameters_.elasticity, this->density(), block);
  }

 protected:
  ElasticKernelLaw(std::string name, double density, const Parameters& parameters,
                   const std::vector<StateVariable>& internal_variables)
      : KernelLaw<Parameters, Kernels>(std::move(name), density, parameters, internal_variables,
                                       initial_pressure(parameters.elasticity)) {}
};

}  // namespace furrow
