// SPDX-License-Identifier: GPL-2.0-or-later
// The law of the tutorial: the conformance suite, and closed forms.
#include "furrow/material/models/von_mises/von_mises.h"

#include <gtest/gtest.h>

#include "furrow/testing/material_conformance.h"
#include "furrow/testing/material_text.h"

namespace furrow::test {
namespace {

const MaterialModels& models() {
  static const MaterialModels list{VonMises::model()};
  return list;
}

INSTANTIATE_TEST_SUITE_P(VonMises, MaterialConformance,
                         ::testing::ValuesIn(conformance_cases(models())), conformance_case_name);

/// Simple shear of G gamma up to the strength: tau = min(G gamma, 2 c_u/sqrt(3)).
TEST(VonMisesTest, SimpleShearEndsAtTheClosedForm) {
  const auto law = material_of_text("von_mises density 1800 E 5e6 nu 0.45 c_u 20e3", models());
  const double G = 5e6 / 2.9, step = 1e-5, limit = 2.0 * 20e3 / std::sqrt(3.0);
  VectorX state = law->initial_state();
  for (int n = 1; n <= 3000; ++n) {
    Matrix3 gradient = Matrix3::Zero();
    gradient(0, 2) = step;
    law->update_point(gradient, state);
    EXPECT_NEAR(stress_of(state)[5], std::min(G * n * step, limit), 2e-3 * limit);
  }
}

}  // namespace
}  // namespace furrow::test
