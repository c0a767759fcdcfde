// SPDX-License-Identifier: GPL-2.0-or-later
// What every law must do, whatever it models. A new law joins with one line in laws_under_test().

#include <random>
#include <set>

#include <gmock/gmock.h>

#include "core/error.h"
#include "paths.h"

namespace furrow {
namespace {

using testing_paths::material_of;
using testing_paths::stretch;

const std::string snow_table =
    " hardening table p 113.76 5e4 1e6 6e7 eps_vol_pl 0 0.593 1.083 1.514 beyond extrapolate "
    "interpolation ";

std::vector<std::string> laws_under_test() {
  return {
      "drucker_prager_cap density 200 d 5e3 beta 22.53 R 0.02 eps_vol_pl_0 0.3 elasticity linear E "
      "13.79e6 nu 0.3" +
          snow_table + "linear",
      "drucker_prager_cap density 200 d 5e3 beta 22.53 R 0.3 alpha 0.05 K 0.8 tension 2e3 "
      "eps_vol_pl_0 0.3 "
      "elasticity porous kappa 0.005 e0 3.5 p0 10 pt_el 1.5e4 nu 0.3" +
          snow_table + "log",
      "crushable_foam density 200 pt 11.376 sigma0 275.79 K 0.9 elasticity porous elasticity.kappa "
      "0.005 elasticity.e0 3.5 "
      "pt_el 113.76 nu 0.3 "
      "hardening exponential pc0 113.76 lambda 0.35 hardening.kappa 0.005 hardening.e0 3.5",
      "elastic density 1600 elasticity linear E 5e6 nu 0.2",
      "elastic density 1600 elasticity porous kappa 0.01 e0 0.7 p0 1e4 pt_el 1e3 G 2e6",
      "neo_hookean density 1100 G 1e6 bulk 5e7",
  };
}

class Conformance : public ::testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Material> material_ = material_of(GetParam());
  std::mt19937 engine_{7};
  std::normal_distribution<double> normal_;

  Matrix3 random_gradient(double size) {
    Matrix3 h;
    for (int i = 0; i < 9; ++i) h(i) = size * normal_(engine_);
    return h;
  }
  Matrix3 random_rotation() {
    return Eigen::AngleAxisd(
               2 * normal_(engine_),
               Vector3(normal_(engine_), normal_(engine_), normal_(engine_)).normalized())
        .toRotationMatrix();
  }
  /// The strain at which this law's stress is about its strength, or 1e-3.
  double strain_scale(const VectorX& state) const {
    return std::min(1e-3, 2 * material_->stress_scale(state) / material_->moduli(state).wave());
  }
  /// A state somewhere on the way, after steps of mixed kind.
  VectorX some_state() {
    VectorX state = material_->initial_state();
    for (int step = 0; step < 10; ++step)
      material_->update_point(random_gradient(strain_scale(state)), state);
    return state;
  }
  /// The same state seen from a turned frame.
  VectorX turned(const VectorX& state, const Matrix3& Q) const {
    VectorX result = state;
    result.segment<6>(field::stress) = to_vector6(Q * to_matrix(stress_of(state)) * Q.transpose());
    if (material_->name() == "neo_hookean")
      result.segment<6>(field::own) =
          to_vector6(Q * to_matrix(state.segment<6>(field::own)) * Q.transpose());
    return result;
  }
};

TEST(ConformanceSuite, EveryRegisteredLawTakesPart) {
  std::set<std::string> tested;
  for (const std::string& text : laws_under_test()) tested.insert(text.substr(0, text.find(' ')));
  for (const MaterialModel& material : material_models())
    EXPECT_TRUE(tested.count(material.name)) << material.name << " is not in laws_under_test()";
}

TEST_P(Conformance, StateIsDescribed) {
  std::set<std::string> names;
  for (const StateField& field : material_->state_fields()) {
    EXPECT_TRUE(names.insert(field.name).second) << field.name << " twice";
    EXPECT_FALSE(field.meaning.empty()) << field.name;
    EXPECT_EQ(
        material_->initial_state()[static_cast<Eigen::Index>(material_->field_index(field.name))],
        field.initial);
  }
  EXPECT_EQ(material_->field_index("stress_xz"), field::stress + 5);
  EXPECT_EQ(material_->field_index("volume_ratio"), field::volume_ratio);
  EXPECT_EQ(material_->field_index("dissipated_energy"), field::dissipated_energy);
  EXPECT_THROW(material_->field_index("colour"), Error);
}

TEST_P(Conformance, NoStepNoChange) {
  VectorX state = some_state();
  const VectorX before = state;
  material_->update_point(Matrix3::Zero(), state);
  EXPECT_LT((stress_of(state) - stress_of(before)).norm(), 1e-13 * material_->stress_scale(before));
  EXPECT_EQ(state[field::volume_ratio], before[field::volume_ratio]);
}

TEST_P(Conformance, FirstStepHasTheElasticModuli) {
  const VectorX start = material_->initial_state();
  const ElasticModuli moduli = material_->moduli(start);
  const double strain = 1e-3 * strain_scale(start);
  for (const double sign : {1.0, -1.0}) {
    VectorX volume = start, shear = start;
    material_->update_point(
        stretch((Vector6() << 1, 1, 1, 0, 0, 0).finished() * (sign * strain / 3)), volume);
    material_->update_point(stretch((Vector6() << 0, 0, 0, 0.5, 0, 0).finished() * (sign * strain)),
                            shear);
    const double p0 = invariants(stress_of(start)).p;
    EXPECT_NEAR((p0 - invariants(stress_of(volume)).p) / (sign * strain * moduli.bulk), 1.0, 1e-2);
    EXPECT_NEAR(shear[3] / (sign * strain * moduli.shear), 1.0, 1e-2);
  }
  EXPECT_NEAR(material_->wave_speed(start),
              std::sqrt((moduli.bulk + 4 * moduli.shear / 3) / material_->density()),
              1e-12 * material_->wave_speed(start));
}

/// sigma(Q F Q^T, Q sigma Q^T) = Q sigma(F) Q^T: isotropic and objective.
TEST_P(Conformance, TurnedFrameGivesTurnedStress) {
  for (int trial = 0; trial < 50; ++trial) {
    const VectorX start = some_state();
    const Matrix3 h = random_gradient(strain_scale(start)), Q = random_rotation();
    VectorX here = start, there = turned(start, Q);
    material_->update_point(h, here);
    material_->update_point(Q * h * Q.transpose(), there);
    EXPECT_LT((stress_of(there) - stress_of(turned(here, Q))).norm(),
              1e-9 * material_->stress_scale(here));
    EXPECT_NEAR(there[field::dissipated_energy], here[field::dissipated_energy],
                1e-9 * material_->stress_scale(here));
  }
}

/// A rotation after the step turns the result and nothing else: sigma(Q F) = Q sigma(F) Q^T.
TEST_P(Conformance, SuperposedRotationOnlyTurnsTheStress) {
  for (int trial = 0; trial < 50; ++trial) {
    const VectorX start = some_state();
    const Matrix3 h = random_gradient(strain_scale(start)), Q = random_rotation();
    VectorX plain = start, rotated = start;
    material_->update_point(h, plain);
    material_->update_point(Q * (Matrix3::Identity() + h) - Matrix3::Identity(), rotated);
    EXPECT_LT((stress_of(rotated) - stress_of(turned(plain, Q))).norm(),
              1e-9 * material_->stress_scale(plain));
  }
}

TEST_P(Conformance, ManyTurnsOfRigidSpinKeepTheStress) {
  const VectorX start = some_state();
  VectorX state = start;
  const Vector3 axis = Vector3(1, 2, -0.5).normalized();
  double angle = 0.0;
  for (int step = 1; step <= 1000; ++step) {  // 50 turns; see elastic_test.cpp for the uneven steps
    const double next = step < 1000 ? angle + 0.1 * pi * (1 + 0.5 * std::sin(step)) : 100 * pi;
    material_->update_point(
        Eigen::AngleAxisd(next - angle, axis).toRotationMatrix() - Matrix3::Identity(), state);
    angle = next;
  }
  // The rotations given are rigid to 1e-16 only: what they strain, the stiffness turns into stress.
  const double input_error = 1e-14 * material_->moduli(start).wave();
  EXPECT_LT((stress_of(state) - stress_of(start)).norm(),
            1e-10 * material_->stress_scale(start) + input_error);
}

TEST_P(Conformance, BlocksOfAnySizeAndAlignmentAgreeWithSinglePoints) {
  constexpr std::size_t n = 37;
  const std::size_t fields = material_->state_fields().size();
  std::vector<std::vector<double>> gradient(9, std::vector<double>(n + 1)),
      state(fields, std::vector<double>(n + 1, -7.0));
  std::vector<VectorX> expected;
  UpdateReport sum;
  std::vector<Branch> branches(n);
  for (std::size_t i = 0; i < n; ++i) {
    VectorX point = some_state();
    for (std::size_t f = 0; f < fields; ++f) state[f][i + 1] = point[static_cast<Eigen::Index>(f)];
    // one point strains much
    const Matrix3 h = random_gradient(i == 5 ? 0.3 : strain_scale(point));
    for (std::size_t k = 0; k < 9; ++k)
      gradient[k][i + 1] = h(static_cast<Eigen::Index>(k / 3), static_cast<Eigen::Index>(k % 3));
    sum += material_->update_point(h, point, &branches[i]);
    expected.push_back(point);
  }
  std::vector<double*> pointers;
  for (auto& array : state) pointers.push_back(array.data() + 1);
  std::vector<std::uint8_t> found(n);
  PointBlock block;
  block.size = n;
  for (std::size_t k = 0; k < 9; ++k) block.gradient[k] = gradient[k].data() + 1;
  block.state = pointers.data();
  block.branch = found.data();
  const UpdateReport report = material_->update_block(block);
  EXPECT_EQ(report.size(), n);
  EXPECT_EQ(report.points, sum.points);
  EXPECT_EQ(report.beyond_ice, sum.beyond_ice);
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_EQ(found[i], static_cast<std::uint8_t>(branches[i]));
    for (std::size_t f = 0; f < fields; ++f)
      EXPECT_NEAR(state[f][i + 1], expected[i][static_cast<Eigen::Index>(f)],
                  1e-11 * (1 + material_->stress_scale(expected[i])))
          << material_->state_fields()[f].name << " of point " << i;
  }
  for (std::size_t f = 0; f < fields; ++f) EXPECT_EQ(state[f][0], -7.0) << "wrote before the array";
  double fastest = 0;
  for (const VectorX& point : expected) fastest = std::max(fastest, material_->wave_speed(point));
  EXPECT_NEAR(material_->largest_wave_speed(block) / fastest, 1.0, 1e-12);
}

/// The work of the stress goes into the three energies, but for an error of second order in the
/// step.
TEST_P(Conformance, WorkIsAccountedFor) {
  const VectorX start = material_->initial_state();
  std::array<double, 2> miss{};
  double total = 0;
  for (std::size_t level = 0; level < 2; ++level) {
    const int steps = 2000 << level;
    VectorX state = start;
    double work = 0;
    const double size = 20 * strain_scale(start);
    for (int step = 0; step < steps; ++step) {
      const double phase = (step + 0.5) / steps;
      const Vector6 rate = size *
                           (Vector6() << -1, -0.3 * phase, -1.5 + 3 * phase * phase, 0.5, 0,
                            0.4 * std::cos(4 * phase))
                               .finished() /
                           steps;
      const Vector6 before = stress_of(state);
      const double old_volume = state[field::volume_ratio];
      material_->update_point(stretch(rate), state);
      const double power = (0.5 * (before + stress_of(state)))
                               .cwiseProduct((Vector6() << 1, 1, 1, 2, 2, 2).finished())
                               .dot(rate);
      work += 0.5 * (old_volume + state[field::volume_ratio]) * power;
    }
    const double energy =
        state[field::stored_energy] + state[field::frozen_energy] + state[field::dissipated_energy];
    const double before = start[field::stored_energy];
    miss[level] = std::abs(work - (energy - before));
    total = std::max(total, std::abs(work));
  }
  EXPECT_LT(miss[1], 1e-3 * total);
  EXPECT_LT(miss[1], 0.6 * miss[0] + 1e-4 * total);
}

TEST_P(Conformance, TangentPredictsTheNextStress) {
  for (int trial = 0; trial < 20; ++trial) {
    const VectorX start = some_state();
    Matrix3 h = random_gradient(strain_scale(start));
    h = (0.5 * (h + h.transpose())).eval();
    const Matrix6 tangent = material_->tangent(h, start);
    EXPECT_TRUE(tangent.allFinite());
    Vector6 change;
    for (int k = 0; k < 6; ++k) change[k] = 1e-5 * strain_scale(start) * normal_(engine_);
    VectorX base = start, moved = start;
    material_->update_point(h, base);
    material_->update_point(h + to_matrix(change), moved);
    const double reached = material_->moduli(start).wave() * change.norm();
    EXPECT_LT((stress_of(moved) - stress_of(base) - tangent * change).norm(), 2e-2 * reached)
        << "trial " << trial;
  }
}

/// The bound for the explicit time step: no direction of an elastic point is stiffer than the wave
/// modulus, but for the stress that the waves ride on. Laws that yield are asked at rest (flow that
/// is not associated need not keep the bound, see wave_speed()).
TEST_P(Conformance, WaveModulusBoundsTheElasticTangent) {
  const bool yields = std::isfinite(material_->yield_function(material_->initial_state()));
  for (int trial = 0; trial < 20; ++trial) {
    const VectorX state = yields ? material_->initial_state() : some_state();
    const Matrix6 tangent = material_->tangent(Matrix3::Zero(), state);
    const double stress = stress_of(state).cwiseAbs().maxCoeff();
    for (int k = 0; k < 3; ++k)
      EXPECT_LE(tangent(k, k), 1.001 * material_->moduli(state).wave() + 2 * stress);
  }
}

TEST_P(Conformance, YieldSurfaceIsWhereTheYieldFunctionVanishes) {
  const VectorX state = some_state();
  EXPECT_LE(material_->yield_function(state), 1e-8 * material_->stress_scale(state));
  const std::vector<Vector2> line = material_->yield_surface(state);
  if (line.empty()) {
    EXPECT_EQ(material_->yield_function(state), -std::numeric_limits<double>::infinity());
    return;
  }
  EXPECT_GE(line.size(), 100u);
  EXPECT_NEAR(line.back()[1], 0.0, 1e-9 * material_->stress_scale(state));
  for (std::size_t i = 0; i < line.size(); ++i) {
    const double p = line[i][0], q = line[i][1];
    if (i == 0) continue;
    EXPECT_GE(p, line[i - 1][0]);
    VectorX on = state;  // triaxial compression
    on.segment<6>(field::stress) << -p + q / 3, -p + q / 3, -p - 2 * q / 3, 0, 0, 0;
    EXPECT_NEAR(material_->yield_function(on) / material_->stress_scale(state), 0.0, 1e-7)
        << "p " << p << " q " << q;
  }
}

TEST_P(Conformance, AFoldedOrUndefinedStepStopsWithItsCause) {
  Matrix3 folded = Matrix3::Zero();
  folded(1, 1) = -1.2;
  Matrix3 undefined = Matrix3::Zero();
  undefined(0, 1) = std::numeric_limits<double>::quiet_NaN();
  for (const Matrix3& h : {folded, undefined}) {
    VectorX state = material_->initial_state();
    try {
      material_->update_point(h, state);
      ADD_FAILURE() << "accepted";
    } catch (const PointError& error) {
      EXPECT_EQ(error.point, 0u);
      EXPECT_THAT(error.what(), ::testing::AllOf(::testing::HasSubstr(material_->name()),
                                                 ::testing::HasSubstr("folded or not finite")));
    }
  }
  VectorX state = material_->initial_state();
  state[0] = std::numeric_limits<double>::quiet_NaN();
  if (material_->name() != "neo_hookean") {  // whose stress is a result only
    EXPECT_THROW(material_->update_point(Matrix3::Zero(), state), StateError);
  }
  VectorX short_state = VectorX::Zero(3);
  EXPECT_THROW(material_->update_point(Matrix3::Zero(), short_state), Error);
}

TEST_P(Conformance, ReportsIceDensityWithoutEnforcingIt) {
  VectorX state = material_->initial_state();
  state[field::volume_ratio] = material_->density() / 916.9;
  Matrix3 h = Matrix3::Identity() * -1e-6;
  EXPECT_EQ(material_->update_point(h, state).beyond_ice, 0u);
  h *= 100;
  EXPECT_EQ(material_->update_point(h, state).beyond_ice, 1u);
  EXPECT_GT(material_->current_density(state), 917.0);
}

INSTANTIATE_TEST_SUITE_P(Laws, Conformance, ::testing::ValuesIn(laws_under_test()),
                         [](const auto& material) {
                           return material.param.substr(0, material.param.find(' ')) + "_" +
                                  std::to_string(material.index);
                         });

}  // namespace
}  // namespace furrow
