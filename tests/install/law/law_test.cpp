// SPDX-License-Identifier: GPL-2.0-or-later
// The law does what every law must do, beside those of the library, and relaxes as its equations
// say.

#include <cmath>

#include "standard_linear_solid.h"
#include "furrow/testing/material_conformance.h"

namespace lab {
namespace {

furrow::MaterialModels models() {
  furrow::MaterialModels list = furrow::material_models();
  list.push_back(StandardLinearSolid::model());
  return list;
}

using furrow::MaterialConformance;
INSTANTIATE_TEST_SUITE_P(Laws, MaterialConformance,
                         ::testing::ValuesIn(furrow::conformance_cases(models())),
                         furrow::conformance_case_name);

/// A sudden shear that is held: s_xz = 2 e_xz (G_inf + G_1 exp(-t/tau)).
TEST(StandardLinearSolid, StressAfterAStrainStepRelaxesExponentially) {
  const auto material = furrow::material_of_text(
      "standard_linear_solid density 1500 bulk 5e6 G_inf 1e6 G_1 2e6 tau 0.02", models());
  furrow::VectorX state = material->initial_state();
  const double strain = 1e-6;
  furrow::Matrix3 gradient = furrow::Matrix3::Zero();
  gradient(0, 2) = gradient(2, 0) = strain;
  material->update_point(gradient, state);
  for (int step = 0; step <= 10; ++step) {
    const double stress = 2.0 * strain * (1e6 + 2e6 * std::exp(-0.1 * step));
    EXPECT_NEAR(state[5], stress, 1e-5 * stress);
    material->update_point(furrow::Matrix3::Zero(), state, nullptr, 0.002);
  }
}

}  // namespace
}  // namespace lab
