// SPDX-License-Identifier: GPL-2.0-or-later
// A law written in plain doubles gives what kernels of the same equations give.

#include "furrow/material/pointwise_material.h"

#include <random>

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "furrow/material/pointwise_parameters.h"
#include "plain_elastic.h"
#include "furrow/testing/material_text.h"

namespace furrow::pointwise_material_test {
namespace {

class PointwiseMaterials : public ::testing::Test {
 protected:
  std::unique_ptr<Material> plain_ =
      material_of_text("plain_elastic density 1600 E 5e6 nu 0.2", {PlainElastic::model()});
  std::unique_ptr<Material> kernel_ =
      material_of_text("elastic density 1600 elasticity linear E 5e6 nu 0.2");
};

TEST_F(PointwiseMaterials, PointwiseLawsAgreeWithKernelsOfTheSameEquations) {
  std::mt19937 engine(11);
  std::normal_distribution<double> normal;
  VectorX plain = plain_->initial_state();
  VectorX kernel = kernel_->initial_state();
  for (const double size : {1e-6, 1e-3, 3e-2, 1e-4}) {
    Matrix3 h;
    for (int k = 0; k < 9; ++k) h(k) = size * normal(engine);
    plain_->update_point(h, plain);
    kernel_->update_point(h, kernel);
    EXPECT_LT((stress_of(plain) - stress_of(kernel)).norm(), 1e-13 * stress_of(kernel).norm());
    EXPECT_EQ(plain[field::volume_ratio], kernel[field::volume_ratio]);
    EXPECT_NEAR(plain[field::stored_energy] / kernel[field::stored_energy], 1.0, 1e-12);
  }
}

/// sigma = K tr(e) I + 2 G dev(e) holds for the rotated sums only if the tensor of the law is
/// rotated as the stress is.
TEST_F(PointwiseMaterials, TensorVariablesRotateWithTheStress) {
  std::mt19937 engine(12);
  std::normal_distribution<double> normal;
  VectorX state = plain_->initial_state();
  for (int step = 0; step < 20; ++step) {
    Matrix3 h;
    for (int k = 0; k < 9; ++k) h(k) = 0.02 * normal(engine);
    plain_->update_point(h, state);
  }
  const ElasticModuli moduli = plain_->moduli(state);
  const Matrix3 e = to_matrix(state.segment<6>(PlainElastic::strain));
  const Matrix3 expected =
      (moduli.bulk - 2.0 / 3.0 * moduli.shear) * e.trace() * Matrix3::Identity() +
      2.0 * moduli.shear * e;
  EXPECT_LT((to_matrix(stress_of(state)) - expected).norm(), 1e-12 * expected.norm());
  EXPECT_EQ(state[PlainElastic::steps], 20.0);
}

TEST_F(PointwiseMaterials, ReportBranchIterationsAndData) {
  VectorX state = plain_->initial_state();
  const Matrix3 h = Matrix3::Identity() * 1e-6;
  Branch branch{};
  EXPECT_EQ(plain_->update_point(h, state, &branch).points[0], 1u);
  EXPECT_EQ(branch, Branch::elastic);
  const UpdateReport second = plain_->update_point(h, state, &branch);
  EXPECT_EQ(branch, Branch::cap);
  EXPECT_EQ(second.points[static_cast<std::size_t>(Branch::cap)], 1u);
  EXPECT_EQ(second.iterations, 3u);
  EXPECT_EQ(second.beyond_data, 0u);
  EXPECT_EQ(plain_->update_point(h, state).beyond_data, 1u);
}

TEST_F(PointwiseMaterials, ErrorNamesPointAndCause) {
  constexpr std::size_t n = 21;
  constexpr std::size_t bad = 13;
  const std::size_t fields = plain_->state_fields().size();
  std::vector<std::vector<double>> gradient(9, std::vector<double>(n, 0.0));
  std::vector<std::vector<double>> state(fields, std::vector<double>(n));
  std::vector<double*> pointers;
  for (std::size_t f = 0; f < fields; ++f) {
    state[f].assign(n, plain_->state_fields()[f].initial);
    pointers.push_back(state[f].data());
  }
  for (const std::size_t k : {0, 4, 8}) gradient[k][bad] = -0.6;
  PointBlock block;
  block.size = n;
  for (std::size_t k = 0; k < 9; ++k) block.gradient[k] = gradient[k].data();
  block.state = pointers.data();
  try {
    plain_->update_block(block);
    FAIL();
  } catch (const PointError& error) {
    EXPECT_EQ(error.point, bad);
    EXPECT_THAT(error.what(), ::testing::AllOf(::testing::HasSubstr("law plain_elastic"),
                                               ::testing::HasSubstr("compacted too much"),
                                               ::testing::HasSubstr("H = -0.6 0 0 0 -0.6")));
  }
}

TEST(PointwiseMaterial, TooManyVariablesAreRefused) {
  class Greedy : public PointwiseMaterial {
   public:
    Greedy()
        : PointwiseMaterial("greedy", 1.0,
                            std::vector<StateVariable>(max_pointwise_variables + 1,
                                                       {"number", "", "one of many", 0.0})) {}
    ElasticModuli moduli(const VectorX&) const override { return {1.0, 1.0}; }

   private:
    void step(PointStep&) const override {}
  };
  EXPECT_THROW(Greedy(), Error);
}

}  // namespace
}  // namespace furrow::pointwise_material_test
