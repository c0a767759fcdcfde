// SPDX-License-Identifier: GPL-2.0-or-later
// The Drucker-Prager law against closed forms.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "furrow/material/material.h"
#include "tests/support/paths.h"

namespace furrow::drucker_prager_test {
namespace {

using testing_paths::material_of;
using testing_paths::stretch;

constexpr double d = 8e3, beta = 40.0, E = 5e7, nu = 0.25;

std::string law(double psi) {
  return fmt::format("drucker_prager density 1600 d {} beta {} psi {} elasticity linear E {} nu {}",
                     d, beta, psi, E, nu);
}

/// Plane strain that widens by the dilation angle keeps the stress. It then lies on the line of
/// Mohr-Coulomb whose sin(phi) and c cos(phi) are, with b = tan(beta) and f = tan(psi),
///   b sqrt(3 (9 - f^2))/(9 - b f) and d sqrt(3 (9 - f^2))/(9 - b f) (theory: laws, eq. 22).
/// Work is dissipated as sigma1 de1 + sigma3 de3.
TEST(DruckerPrager, StrengthInPlaneStrainIsMohrCoulomb) {
  const double b = std::tan(radians(beta));
  for (const double psi : {0.0, 15.0, beta}) {
    const auto material = material_of(law(psi));
    const double f = std::tan(radians(psi)), root = std::sqrt(3.0 * (9.0 - f * f)),
                 sin_psi = 3.0 * f / root, part = 1e-4;
    VectorX state = material->initial_state();
    for (int step = 0; step < 5; ++step)  // some pressure to begin with
      material->update_point(stretch((Vector6() << -part, -part, -part, 0, 0, 0).finished()),
                             state);
    Matrix3 before = Matrix3::Zero();
    double heat = 0.0;
    const Vector6 strain =
        (Vector6() << part * (1 + sin_psi), 0, -part * (1 - sin_psi), 0, 0, 0).finished();
    for (int step = 0; step < 400; ++step) {
      before = to_matrix(state.head<6>());
      heat = state[field::dissipated_energy];
      material->update_point(stretch(strain), state);
    }
    const Matrix3 stress = to_matrix(state.head<6>());
    EXPECT_LT((stress - before).norm(), 1e-8 * stress.norm()) << psi;
    const double radius = 0.5 * (stress(0, 0) - stress(2, 2)),
                 centre = -0.5 * (stress(0, 0) + stress(2, 2));
    EXPECT_NEAR(radius / ((d + centre * b) * root / (9.0 - b * f)), 1.0, 1e-7) << psi;
    EXPECT_NEAR((state[field::dissipated_energy] - heat) /
                    (state[field::volume_ratio] * stress.diagonal().dot(strain.head<3>())),
                1.0, 1e-3)
        << psi;
  }
}

/// Tension ends at the apex, without shear.
TEST(DruckerPrager, TensionEndsAtTheApex) {
  for (const double psi : {0.0, 15.0, beta}) {
    const auto material = material_of(law(psi));
    VectorX state = material->initial_state();
    for (int step = 0; step < 20; ++step)
      material->update_point(stretch((Vector6() << 2e-4, 1e-4, 1e-4, 1e-5, 0, 0).finished()),
                             state);
    const Invariants stress = invariants(stress_of(state));
    EXPECT_NEAR(stress.p * std::tan(radians(beta)) / -d, 1.0, 1e-9) << psi;
    EXPECT_LT(stress.q, 1e-6 * d) << psi;
  }
}

}  // namespace
}  // namespace furrow::drucker_prager_test
