// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Base of laws that are written for one point, in plain doubles: the first version of a law.
///
/// Finite strain, rotation, energies, checks and the report are those of every law, so results
/// agree with kernels of the same equations to rounding. The cost is one virtual call per point and
/// the loss of SIMD (tests/benchmarks/material_update). Laws of large scenes move to kernels
/// (README.md).

#include <cstddef>
#include <string>
#include <vector>

#include "furrow/material/material.h"

namespace furrow {

/// One point in a step of a pointwise law, in the frame of the start of the step.
struct PointStep {
  Matrix3 strain;       ///< logarithmic strain increment ln U of the step, tension positive
  double time_step;     ///< [s]; 0: infinitely fast
  double volume_ratio;  ///< J at the start of the step

  // ---- at the start of the step, to be replaced by what holds at its end
  Matrix3 stress;  ///< Cauchy stress, tension positive [Pa]
  /// Internal variables in the order of their declaration. A tensor is six numbers xx, yy, zz, xy,
  /// yz, xz, which are rotated like the stress after the step.
  Eigen::Map<VectorX> internal;

  // ---- of the step, to be set; energies per current volume [J/m^3]
  double stored = 0.0;      ///< change of the elastic energy
  double frozen = 0.0;      ///< plastic work that compaction stores
  double dissipated = 0.0;  ///< turned into heat, >= 0
  Branch branch = Branch::elastic;
  std::size_t iterations = 0;  ///< of the solver of the law, for the report
  bool below_data = false;     ///< the hardening was extrapolated, for the report
  bool beyond_data = false;
};

/// Derive from it and write step(), moduli(), and yield_function() and stress_scale() if the law
/// yields. Immutable as every Material.
class PointwiseMaterial : public Material {
 public:
  UpdateReport update_block(const PointBlock& block) const final;

 protected:
  /// @param internal_variables  what the law keeps after the common fields, at most
  ///                            max_pointwise_variables numbers (pointwise_parameters.h)
  /// @param pressure            at the start of a run [Pa]
  PointwiseMaterial(std::string name, double density,
                    const std::vector<StateVariable>& internal_variables, double pressure = 0.0);

  /// Takes one step of one point. The caller refuses a stress or variable that is not finite.
  /// @throws StateError with the cause when the law itself must refuse the step
  virtual void step(PointStep& point) const = 0;

 private:
  std::vector<int> internal_tensors_;
};

}  // namespace furrow
