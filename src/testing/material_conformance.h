// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Conformance suite for every constitutive law of any program (GoogleTest). Include it in one
/// source file of a test program and run it with every example of every law:
///
///   INSTANTIATE_TEST_SUITE_P(Laws, MaterialConformance,
///                            ::testing::ValuesIn(conformance_cases(my_models())),
///                            conformance_case_name);

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "furrow/material/registry.h"
#include "furrow/testing/material_text.h"
#include "furrow/testing/stretch.h"

namespace furrow {

/// A law with one of its examples.
struct ConformanceCase {
  MaterialModel model;
  std::string example;  ///< empty when the law has none, which fails
  std::size_t number = 0;
};

inline std::vector<ConformanceCase> conformance_cases(const MaterialModels& models) {
  std::vector<ConformanceCase> cases;
  for (const MaterialModel& model : models) {
    if (model.examples.empty()) cases.push_back({model, "", 0});
    for (std::size_t k = 0; k < model.examples.size(); ++k)
      cases.push_back({model, model.examples[k], k});
  }
  return cases;
}
inline std::string conformance_case_name(const ::testing::TestParamInfo<ConformanceCase>& info) {
  return info.param.model.name + "_" + std::to_string(info.param.number);
}
inline void PrintTo(const ConformanceCase& c, std::ostream* stream) {
  *stream << c.model.name << " " << c.example;
}

class MaterialConformance : public ::testing::TestWithParam<ConformanceCase> {
 protected:
  void SetUp() override {
    ASSERT_FALSE(GetParam().example.empty())
        << "law " << GetParam().model.name << " has no example in its model()";
    material_ = make_material(GetParam().model, entries_of_text(GetParam().example));
    if (material_->rate_dependent()) time_step_ = 0.3 * response_time();
  }

  Matrix3 random_gradient(double size) {
    Matrix3 h;
    for (int i = 0; i < 9; ++i) h(i) = size * normal_(engine_);
    return h;
  }
  Matrix3 random_rotation() {
    const double angle = 2 * normal_(engine_);
    const Vector3 axis{normal_(engine_), normal_(engine_), normal_(engine_)};
    return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  }
  /// The strain at which the stress is about the strength, or 1e-3.
  double strain_scale(const VectorX& state) const {
    return std::min(1e-3, 2 * material_->stress_scale(state) / material_->moduli(state).wave());
  }
  /// A state somewhere on the way, after steps of mixed kind.
  VectorX some_state() {
    VectorX state = material_->initial_state();
    for (int step = 0; step < 10; ++step)
      update(random_gradient(strain_scale(state)), state, time_step_);
    return state;
  }
  UpdateReport update(const Matrix3& gradient, VectorX& state, double time_step) const {
    return material_->update_point(gradient, state, nullptr, time_step);
  }
  /// Time [s] in which the stress after a sudden, constant strain completes half of its change.
  double response_time() const {
    const auto after = [&](double time) {
      VectorX state = material_->initial_state();
      Matrix3 h = Matrix3::Zero();
      h(0, 2) = 2 * strain_scale(state);
      update(h, state, 0.0);
      update(Matrix3::Zero(), state, time);
      return stress_of(state);
    };
    const Vector6 first = after(0.0);
    const double all = (after(1e12) - first).norm();
    double time = 1e-9;
    while (time < 1e9 && (after(time) - first).norm() < 0.5 * all) time *= 1.5;
    return time;
  }
  /// Derivative of the new stress with respect to the strain of the step [Pa], consistent with the
  /// algorithm. Column j is the change of the six stresses for a change of symmetric H_j (both
  /// entries for a shear). Central differences, relative error about 1e-8 where the law is smooth.
  Eigen::Matrix<double, 6, 6> tangent(const Matrix3& gradient, const VectorX& state) const {
    // Step near the cube root of the precision, so that truncation and rounding of the central
    // difference are alike.
    const double step = 2e-6 * std::min(std::max(gradient.norm(), 1e-4), 1.0);
    Eigen::Matrix<double, 6, 6> result;
    for (int j = 0; j < 6; ++j) {
      Vector6 direction = Vector6::Zero();
      direction[j] = step;
      VectorX forward = state;
      VectorX backward = state;
      update(gradient + to_matrix(direction), forward, 0.0);
      update(gradient - to_matrix(direction), backward, 0.0);
      result.col(j) = (stress_of(forward) - stress_of(backward)) / (2.0 * step);
    }
    return result;
  }

  std::unique_ptr<Material> material_;
  double time_step_ = 0.0;  ///< [s] in which a rate-dependent law shows
  std::mt19937 engine_{7};
  std::normal_distribution<double> normal_;
};

TEST_P(MaterialConformance, StateIsDescribed) {
  const std::vector<StateField>& fields = material_->state_fields();
  const VectorX start = material_->initial_state();
  ASSERT_EQ(static_cast<std::size_t>(start.size()), fields.size());
  std::set<std::string> names;
  for (std::size_t f = 0; f < fields.size(); ++f) {
    EXPECT_TRUE(names.insert(fields[f].name).second) << fields[f].name << " twice";
    EXPECT_FALSE(fields[f].meaning.empty()) << fields[f].name;
    EXPECT_EQ(start[static_cast<Eigen::Index>(f)], fields[f].initial);
  }
  EXPECT_EQ(fields[field::stress + 5].name, "stress_xz");
  EXPECT_EQ(fields[field::volume_ratio].name, "volume_ratio");
  EXPECT_EQ(fields[field::dissipated_energy].name, "dissipated_energy");
  ASSERT_FALSE(material_->tensor_fields().empty());
  EXPECT_EQ(material_->tensor_fields().front(), field::stress);
  for (const std::size_t first : material_->tensor_fields()) {
    ASSERT_LE(first + 6, fields.size());
    EXPECT_EQ(fields[first].name.substr(fields[first].name.size() - 3), "_xx");
    EXPECT_EQ(fields[first + 5].name.substr(fields[first + 5].name.size() - 3), "_xz");
  }
}

TEST_P(MaterialConformance, ZeroStepChangesNothing) {
  VectorX state = some_state();
  const VectorX before = state;
  update(Matrix3::Zero(), state, 0.0);
  EXPECT_LT((stress_of(state) - stress_of(before)).norm(), 1e-13 * material_->stress_scale(before));
  EXPECT_EQ(state[field::volume_ratio], before[field::volume_ratio]);
}

TEST_P(MaterialConformance, FirstStepHasTheElasticModuli) {
  const VectorX start = material_->initial_state();
  const ElasticModuli moduli = material_->moduli(start);
  const double strain = 1e-3 * strain_scale(start);
  for (const double sign : {-1.0, 1.0}) {
    VectorX volume = start;
    VectorX shear = start;
    update(stretch((Vector6() << 1, 1, 1, 0, 0, 0).finished() * (sign * strain / 3)), volume, 0.0);
    update(stretch((Vector6() << 0, 0, 0, 0.5, 0, 0).finished() * (sign * strain)), shear, 0.0);
    const double p0 = invariants(stress_of(start)).p;
    if (sign > 0 && volume[field::dissipated_energy] != 0.0) continue;  // yields at once in tension
    EXPECT_NEAR((p0 - invariants(stress_of(volume)).p) / (sign * strain * moduli.bulk), 1.0, 1e-2);
    EXPECT_NEAR(shear[3] / (sign * strain * moduli.shear), 1.0, 1e-2);
  }
  EXPECT_NEAR(material_->wave_speed(start),
              std::sqrt((moduli.bulk + 4 * moduli.shear / 3) / material_->density()),
              1e-12 * material_->wave_speed(start));
}

/// sigma(Q F Q^T, Q sigma Q^T) = Q sigma(F) Q^T: isotropic and objective.
TEST_P(MaterialConformance, RotatedFrameGivesRotatedStress) {
  for (int trial = 0; trial < 50; ++trial) {
    const VectorX start = some_state();
    const Matrix3 h = random_gradient(strain_scale(start));
    const Matrix3 Q = random_rotation();
    VectorX here = start;
    VectorX there = material_->rotated(start, Q);
    update(h, here, time_step_);
    update(Q * h * Q.transpose(), there, time_step_);
    EXPECT_LT((stress_of(there) - stress_of(material_->rotated(here, Q))).norm(),
              1e-9 * material_->stress_scale(here));
    EXPECT_NEAR(there[field::dissipated_energy], here[field::dissipated_energy],
                1e-9 * material_->stress_scale(here));
  }
}

/// A rotation after the step rotates the result and nothing else: sigma(Q F) = Q sigma(F) Q^T.
TEST_P(MaterialConformance, SuperposedRotationOnlyRotatesTheState) {
  for (int trial = 0; trial < 50; ++trial) {
    const VectorX start = some_state();
    const Matrix3 h = random_gradient(strain_scale(start));
    const Matrix3 Q = random_rotation();
    VectorX plain = start;
    VectorX rotated = start;
    update(h, plain, time_step_);
    update(Q * (Matrix3::Identity() + h) - Matrix3::Identity(), rotated, time_step_);
    const VectorX expected = material_->rotated(plain, Q);
    EXPECT_LT((stress_of(rotated) - stress_of(expected)).norm(),
              1e-9 * material_->stress_scale(plain));
    for (const std::size_t first : material_->tensor_fields()) {
      const auto tensor = static_cast<Eigen::Index>(first);
      EXPECT_LT((rotated.segment<6>(tensor) - expected.segment<6>(tensor)).norm(),
                1e-9 * (expected.segment<6>(tensor).norm() +
                        (first == field::stress ? material_->stress_scale(plain) : 0.0)) +
                    1e-14)
          << material_->state_fields()[first].name;
    }
  }
}

TEST_P(MaterialConformance, FiftyRigidTurnsKeepTheStress) {
  const VectorX start = some_state();
  VectorX state = start;
  const Vector3 axis = Vector3(1, 2, -0.5).normalized();
  double angle = 0.0;
  // Uneven steps: a rotation written in doubles is rigid to 1e-16 only, and this error of the input
  // is not to add up in one direction.
  for (int step = 1; step <= 1000; ++step) {
    const double next = step < 1000 ? angle + 0.1 * pi * (1 + 0.5 * std::sin(step)) : 100 * pi;
    update(Eigen::AngleAxisd(next - angle, axis).toRotationMatrix() - Matrix3::Identity(), state,
           0.0);
    angle = next;
  }
  // The stiffness turns the strain of the rotations into stress.
  const double input_error = 2e-14 * material_->moduli(start).wave();
  EXPECT_LT((stress_of(state) - stress_of(start)).norm(),
            1e-10 * material_->stress_scale(start) + input_error);
}

TEST_P(MaterialConformance, BlocksOfAnySizeAndAlignmentAgreeWithSinglePoints) {
  constexpr std::size_t n = 37;
  const std::size_t fields = material_->state_fields().size();
  std::vector<std::vector<double>> gradient(9, std::vector<double>(n + 1));
  std::vector<std::vector<double>> state(fields, std::vector<double>(n + 1, -7.0));
  std::vector<VectorX> expected;
  UpdateReport sum;
  std::vector<Branch> branches(n);
  for (std::size_t i = 0; i < n; ++i) {
    VectorX point = some_state();
    for (std::size_t f = 0; f < fields; ++f) state[f][i + 1] = point[static_cast<Eigen::Index>(f)];
    // one point has a large strain
    const Matrix3 h = random_gradient(i == 5 ? 0.3 : strain_scale(point));
    for (std::size_t k = 0; k < 9; ++k)
      gradient[k][i + 1] = h(static_cast<Eigen::Index>(k / 3), static_cast<Eigen::Index>(k % 3));
    sum += material_->update_point(h, point, &branches[i], time_step_);
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
  block.time_step = time_step_;
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

/// The work of the stress equals the change of the three energies up to an error of second order in
/// the step, for steps without duration and, if the law depends on the rate, in its response time.
TEST_P(MaterialConformance, WorkIsStoredFrozenOrDissipated) {
  std::vector<double> durations{0.0};
  if (material_->rate_dependent()) durations.push_back(time_step_ / 0.3);
  for (const double duration : durations) {
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
        update(stretch(rate), state, duration / steps);
        const double power = (0.5 * (before + stress_of(state)))
                                 .cwiseProduct((Vector6() << 1, 1, 1, 2, 2, 2).finished())
                                 .dot(rate);
        work += 0.5 * (old_volume + state[field::volume_ratio]) * power;
      }
      const double energy = state[field::stored_energy] + state[field::frozen_energy] +
                            state[field::dissipated_energy];
      const double before = start[field::stored_energy];
      miss[level] = std::abs(work - (energy - before));
      total = std::max(total, std::abs(work));
    }
    EXPECT_LT(miss[1], 1e-3 * total) << "duration " << duration;
    EXPECT_LT(miss[1], 0.6 * miss[0] + 1e-4 * total) << "duration " << duration;
  }
}

TEST_P(MaterialConformance, StressStaysInsideTheYieldSurfaceAndHeatNeverFalls) {
  for (int path = 0; path < 20; ++path) {
    VectorX state = material_->initial_state();
    for (int step = 0; step < 20; ++step) {
      const double heat = state[field::dissipated_energy];
      const double size = strain_scale(state) * std::pow(10.0, step % 3 - 1);
      update(random_gradient(size), state, time_step_);
      ASSERT_TRUE(state.allFinite());
      const double scale = material_->stress_scale(state);
      if (!material_
               ->rate_dependent()) {  // rate-dependent stress may exceed the surface for a time
        ASSERT_LE(material_->yield_function(state), 1e-8 * scale);
      }
      ASSERT_GE(state[field::dissipated_energy] - heat, -1e-14 * scale);
    }
  }
}

/// Sums dev(strain) - (s_end - s_start)/(2 G) over steps without rotation.
TEST_P(MaterialConformance, EquivalentPlasticStrainIsTotalMinusElastic) {
  const std::optional<std::size_t> kept = material_->find_field("eps_dev_pl");
  if (!kept) return;
  const auto deviator = [](const Vector6& a) {
    Matrix3 m = to_matrix(a);
    m.diagonal().array() -= m.trace() / 3;
    return m;
  };
  VectorX state = material_->initial_state();
  double sum = 0.0;
  int yielded = 0;
  for (int step = 0; step < 200; ++step) {
    Vector6 strain;
    for (int k = 0; k < 6; ++k) strain[k] = strain_scale(state) * normal_(engine_);
    strain.head<3>().array() -= 0.3 * strain_scale(state);
    const VectorX before = state;
    update(stretch(strain), state, time_step_);
    const Matrix3 plastic = deviator(strain) - deviator(stress_of(state) - stress_of(before)) /
                                                   (2 * material_->moduli(before).shear);
    const double part = std::sqrt(2.0 / 3.0) * plastic.norm();
    const double rounding = 1e-15 * material_->stress_scale(state) / material_->moduli(state).shear;
    if (part > 1e-6 * strain.norm() + 100 * rounding) ++yielded;
    sum += part;
    const auto index = static_cast<Eigen::Index>(*kept);
    ASSERT_NEAR(state[index], sum, 1e-9 * sum + 100 * rounding * (step + 1)) << "step " << step;
    ASSERT_GE(state[index], before[index]);
  }
  EXPECT_GT(yielded, 50);
}

TEST_P(MaterialConformance, OnlyRateDependentLawsDependOnTheTimeStep) {
  const VectorX start = some_state();
  const Matrix3 h = random_gradient(strain_scale(start));
  VectorX sudden = start;
  VectorX slow = start;
  update(h, sudden, 0.0);
  update(h, slow, material_->rate_dependent() ? time_step_ : 1.0);
  if (material_->rate_dependent()) {
    EXPECT_GT((stress_of(slow) - stress_of(sudden)).norm(),
              1e-3 * (stress_of(sudden) - stress_of(start)).norm());
  } else {
    EXPECT_EQ(slow, sudden);
  }
}

TEST_P(MaterialConformance, TangentPredictsTheNextStress) {
  for (int trial = 0; trial < 20; ++trial) {
    const VectorX start = some_state();
    Matrix3 h = random_gradient(strain_scale(start));
    h = (0.5 * (h + h.transpose())).eval();
    const Eigen::Matrix<double, 6, 6> derivative = tangent(h, start);
    EXPECT_TRUE(derivative.allFinite());
    Vector6 change;
    for (int k = 0; k < 6; ++k) change[k] = 1e-5 * strain_scale(start) * normal_(engine_);
    VectorX base = start;
    VectorX moved = start;
    update(h, base, 0.0);
    update(h + to_matrix(change), moved, 0.0);
    const double reached = material_->moduli(start).wave() * change.norm();
    EXPECT_LT((stress_of(moved) - stress_of(base) - derivative * change).norm(), 2e-2 * reached)
        << "trial " << trial;
  }
}

/// The bound for the explicit time step: no direction of an elastic point is stiffer than the wave
/// modulus, apart from the contribution of the stress. Laws that yield are checked at rest, because
/// flow that is not associated may exceed the bound (Material::wave_speed()).
TEST_P(MaterialConformance, WaveModulusBoundsTheElasticTangent) {
  const bool yields = std::isfinite(material_->yield_function(material_->initial_state()));
  for (int trial = 0; trial < 20; ++trial) {
    const VectorX state = yields ? material_->initial_state() : some_state();
    const Eigen::Matrix<double, 6, 6> derivative = tangent(Matrix3::Zero(), state);
    const double stress = stress_of(state).cwiseAbs().maxCoeff();
    for (int k = 0; k < 3; ++k)
      EXPECT_LE(derivative(k, k), 1.001 * material_->moduli(state).wave() + 2 * stress);
  }
}

TEST_P(MaterialConformance, YieldFunctionIsZeroOnTheYieldSurface) {
  const VectorX state = some_state();
  const std::vector<Vector2> line = material_->yield_surface(state);
  if (line.empty()) {
    EXPECT_EQ(material_->yield_function(state), -std::numeric_limits<double>::infinity());
    return;
  }
  EXPECT_GE(line.size(), 100u);
  // an open surface continues as a straight line
  const double end = line.back()[1], scale = material_->stress_scale(state);
  if (end > 1e-9 * scale) {
    VectorX beyond = state;
    const Vector2 slope = line.back() - line[line.size() - 2];
    const double p = 10.0 * line.back()[0], q = end + slope[1] / slope[0] * (p - line.back()[0]);
    beyond.segment<6>(field::stress) << -p + q / 3, -p + q / 3, -p - 2 * q / 3, 0, 0, 0;
    EXPECT_NEAR(material_->yield_function(beyond) / scale, 0.0, 1e-7);
  }
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double p = line[i][0];
    const double q = line[i][1];
    EXPECT_GE(p, line[i - 1][0]);
    VectorX on = state;  // triaxial compression
    on.segment<6>(field::stress) << -p + q / 3, -p + q / 3, -p - 2 * q / 3, 0, 0, 0;
    EXPECT_NEAR(material_->yield_function(on) / material_->stress_scale(state), 0.0, 1e-7)
        << "p " << p << " q " << q;
  }
}

TEST_P(MaterialConformance, InvertedOrUndefinedDeformationStopsTheRun) {
  Matrix3 folded = Matrix3::Zero();
  folded(1, 1) = -1.2;
  Matrix3 undefined = Matrix3::Zero();
  undefined(0, 1) = std::numeric_limits<double>::quiet_NaN();
  for (const Matrix3& h : {folded, undefined}) {
    VectorX state = material_->initial_state();
    try {
      update(h, state, 0.0);
      ADD_FAILURE() << "accepted";
    } catch (const PointError& error) {
      EXPECT_EQ(error.point, 0u);
      EXPECT_THAT(error.what(), ::testing::AllOf(::testing::HasSubstr(material_->name()),
                                                 ::testing::HasSubstr("folded or not finite")));
    }
  }
  VectorX short_state = VectorX::Zero(3);
  EXPECT_THROW(update(Matrix3::Zero(), short_state, 0.0), Error);
}

/// Not-a-number in a value that the law reads from the state stops the run. A value that it does
/// not read (the stress of a law that carries its deformation) is replaced.
TEST_P(MaterialConformance, NonFiniteStateStopsTheRun) {
  const VectorX start = some_state();
  VectorX expected = start;
  update(Matrix3::Zero(), expected, 0.0);
  int read = 0;
  for (std::size_t f = 0; f < material_->state_fields().size(); ++f) {
    if (f > field::volume_ratio && f < field::internal) continue;  // energies are sums
    const auto i = static_cast<Eigen::Index>(f);
    VectorX other = start;
    other[i] += 1e-3 * std::max(std::abs(start[i]), f < 6 ? material_->stress_scale(start) : 1e-3);
    update(Matrix3::Zero(), other, 0.0);
    VectorX broken = start;
    broken[i] = std::numeric_limits<double>::quiet_NaN();
    if (other == expected) {
      update(Matrix3::Zero(), broken, 0.0);
      EXPECT_EQ(broken, expected) << material_->state_fields()[f].name;
    } else {
      ++read;
      EXPECT_THROW(update(Matrix3::Zero(), broken, 0.0), StateError)
          << material_->state_fields()[f].name;
    }
  }
  EXPECT_GE(read, 7) << "a tensor and the volume, at least";
}

TEST_P(MaterialConformance, ReportsIceDensityWithoutEnforcingIt) {
  VectorX state = material_->initial_state();
  state[field::volume_ratio] = material_->density() / 916.9;
  Matrix3 h = Matrix3::Identity() * -1e-6;
  EXPECT_EQ(update(h, state, 0.0).beyond_ice, 0u);
  h *= 100;
  EXPECT_EQ(update(h, state, 0.0).beyond_ice, 1u);
  EXPECT_GT(material_->current_density(state), 917.0);
}

}  // namespace furrow
