// SPDX-License-Identifier: GPL-2.0-or-later
#include "tests/support/paths.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include <Eigen/LU>

#include "furrow/material/models/norsand/norsand.h"

namespace furrow::testing_paths {

Vector6 mixed_step(const Material& material, VectorX& state, Vector6 strain,
                   const std::array<bool, 3>& held, const Vector3& target, double tolerance) {
  std::vector<int> free;
  for (int i = 0; i < 3; ++i)
    if (held[static_cast<std::size_t>(i)]) free.push_back(i);
  const auto n = static_cast<Eigen::Index>(free.size());
  const auto residual = [&](const Vector6& e, VectorX& result) {
    result = state;
    material.update_point(stretch(e), result);
    Eigen::VectorXd r(n);
    for (Eigen::Index i = 0; i < n; ++i)
      r[i] = result[free[static_cast<std::size_t>(i)]] - target[free[static_cast<std::size_t>(i)]];
    return r;
  };
  VectorX result;
  Eigen::VectorXd r = residual(strain, result);
  for (int iteration = 0; iteration < 60 && r.norm() > tolerance; ++iteration) {
    Eigen::MatrixXd jacobian(n, n);
    const double h = 1e-7 * std::max(strain.norm(), 1e-6);
    for (Eigen::Index j = 0; j < n; ++j) {
      Vector6 forward = strain, backward = strain;
      forward[free[static_cast<std::size_t>(j)]] += h;
      backward[free[static_cast<std::size_t>(j)]] -= h;
      VectorX scratch;
      const Eigen::VectorXd up = residual(forward, scratch), down = residual(backward, scratch);
      jacobian.col(j) = (up - down) / (2 * h);
    }
    const Eigen::VectorXd change = jacobian.partialPivLu().solve(-r);
    for (double part = 1.0; part > 1e-6; part *= 0.5) {  // shorten a step that does not help
      Vector6 trial = strain;
      for (Eigen::Index i = 0; i < n; ++i)
        trial[free[static_cast<std::size_t>(i)]] += part * change[i];
      const Eigen::VectorXd better = residual(trial, result);
      if (better.norm() < r.norm() || part < 2e-6) {
        strain = trial;
        r = better;
        break;
      }
    }
  }
  if (r.norm() > tolerance)
    throw std::runtime_error("mixed_step does not converge, residual " + std::to_string(r.norm()));
  residual(strain, result);
  state = result;
  return strain;
}

double excess_of_cone(const Material& material, const VectorX& before, const VectorX& after) {
  const auto* sand = dynamic_cast<const NorSand*>(&material);
  if (!sand) return 0.0;
  const NorSandParameters& p = sand->parameters();
  const double change = sand->critical_void_ratio(before[NorSand::image_pressure]) -
                        sand->critical_void_ratio(after[NorSand::image_pressure]);
  const double P = std::max(0.0, invariants(stress_of(after)).p + p.pt);
  return (1.0 - p.N) * p.chi_i * std::abs(change) * P / material.stress_scale(after);
}

}  // namespace furrow::testing_paths
