// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/material.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>
#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

/// One point seen as a block of one.
struct SinglePoint {
  SinglePoint(const Matrix3& gradient, VectorX& state, Branch* branch, double time_step)
      : pointers(static_cast<std::size_t>(state.size())) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) entries[static_cast<std::size_t>(3 * i + j)] = gradient(i, j);
    for (std::size_t f = 0; f < pointers.size(); ++f) pointers[f] = state.data() + f;
    block.size = 1;
    for (std::size_t k = 0; k < 9; ++k) block.gradient[k] = &entries[k];
    block.state = pointers.data();
    block.branch = reinterpret_cast<std::uint8_t*>(branch);
    block.time_step = time_step;
  }
  std::array<double, 9> entries;
  std::vector<double*> pointers;
  PointBlock block;
};

}  // namespace

std::string to_string(Branch branch) {
  static const std::array<const char*, branch_count> names{"elastic", "shear", "transition", "cap",
                                                           "tension"};
  return names.at(static_cast<std::size_t>(branch));
}

std::size_t UpdateReport::size() const {
  std::size_t sum = 0;
  for (const std::size_t count : points) sum += count;
  return sum;
}

UpdateReport& UpdateReport::operator+=(const UpdateReport& other) {
  for (std::size_t b = 0; b < branch_count; ++b) points[b] += other.points[b];
  iterations += other.iterations;
  max_iterations = std::max(max_iterations, other.max_iterations);
  below_data += other.below_data;
  beyond_data += other.beyond_data;
  beyond_ice += other.beyond_ice;
  return *this;
}

Material::Material(std::string name, double density,
                   const std::vector<StateVariable>& internal_variables, double pressure)
    : name_(std::move(name)), density_(density) {
  const auto add = [&](const StateVariable& variable) {
    if (variable.kind == StateVariable::Kind::scalar) {
      fields_.push_back({variable.name, variable.unit, variable.meaning, variable.initial});
      return;
    }
    tensors_.push_back(fields_.size());
    for (const char* component : component_names)
      fields_.push_back({fmt::format("{}_{}", variable.name, component), variable.unit,
                         variable.meaning, component[0] == component[1] ? variable.initial : 0.0});
  };
  add({"stress", "Pa", "Cauchy stress, tension positive", -pressure,
       StateVariable::Kind::symmetric_tensor});
  add({"volume_ratio", "", "J = V/V0; density = rho0/J", 1.0});
  add({"stored_energy", "J/m3", "elastic work per reference volume"});
  add({"frozen_energy", "J/m3", "plastic work stored by compaction, per reference volume"});
  add({"dissipated_energy", "J/m3", "plastic work turned into heat, per reference volume"});
  for (const StateVariable& variable : internal_variables) add(variable);
}

UpdateReport Material::checked(const BlockResult& result, const PointBlock& block) const {
  if (result.failure == Failure::none) return result.report;
  refuse(block, result.failed_point,
         result.failure == Failure::folded ? "the deformation of the step is folded or not finite"
         : result.failure == Failure::table_ends
             ? "the hardening table ends (its rule beyond the table is 'stop')"
             : "the new state is not finite (numbers too large)");
}

void Material::refuse(const PointBlock& block, std::size_t point, const std::string& cause) const {
  std::string step = "H =";
  std::string old = "state at its start:";
  for (const double* h : block.gradient) step += fmt::format(" {:.6g}", h[point]);
  for (std::size_t f = 0; f < fields_.size(); ++f)
    old += fmt::format(" {} {:.6g}", fields_[f].name, block.state[f][point]);
  throw PointError(point, fmt::format("law {}: {}; {}; {}", name_, cause, step, old));
}

std::optional<std::size_t> Material::find_field(const std::string& name) const {
  for (std::size_t f = 0; f < fields_.size(); ++f)
    if (fields_[f].name == name) return f;
  return std::nullopt;
}

VectorX Material::initial_state() const {
  VectorX state(static_cast<Eigen::Index>(fields_.size()));
  for (std::size_t f = 0; f < fields_.size(); ++f)
    state[static_cast<Eigen::Index>(f)] = fields_[f].initial;
  return state;
}

UpdateReport Material::update_point(const Matrix3& gradient, VectorX& state, Branch* branch,
                                    double time_step) const {
  if (static_cast<std::size_t>(state.size()) != fields_.size())
    throw Error(fmt::format("law {} keeps {} numbers a point, the state given has {}", name_,
                            fields_.size(), state.size()));
  SinglePoint point(gradient, state, branch, time_step);
  return update_block(point.block);
}

VectorX Material::rotated(const VectorX& state, const Matrix3& rotation) const {
  VectorX result = state;
  for (const std::size_t first : tensors_) {
    const auto tensor = static_cast<Eigen::Index>(first);
    result.segment<6>(tensor) =
        to_vector6(rotation * to_matrix(state.segment<6>(tensor)) * rotation.transpose());
  }
  return result;
}

double Material::wave_speed(const VectorX& state) const {
  return std::sqrt(moduli(state).wave() / current_density(state));
}

double Material::largest_wave_speed(const PointBlock& block) const {
  VectorX state(static_cast<Eigen::Index>(fields_.size()));
  double largest = 0.0;
  for (std::size_t i = 0; i < block.size; ++i) {
    for (std::size_t f = 0; f < fields_.size(); ++f)
      state[static_cast<Eigen::Index>(f)] = block.state[f][i];
    largest = std::max(largest, wave_speed(state));
  }
  return largest;
}

double Material::yield_function(const VectorX&) const {
  return -std::numeric_limits<double>::infinity();
}

std::vector<Vector2> Material::yield_surface(const VectorX&, std::size_t) const { return {}; }

Invariants invariants(const Vector6& stress) {
  const double p = -(stress[0] + stress[1] + stress[2]) / 3.0;
  Matrix3 s = to_matrix(stress);
  s.diagonal().array() += p;
  const double q = std::sqrt(1.5 * s.squaredNorm());
  const double cos_3t = q > 0.0 ? std::clamp(13.5 * (s / q).determinant(), -1.0, 1.0) : -1.0;
  return {p, q, cos_3t};
}

double yield_measure(const Invariants& stress, double flow_ratio) {
  const double inverse = 1.0 / flow_ratio;
  return 0.5 * stress.q * (1.0 + inverse - (1.0 - inverse) * stress.cos_3t);
}

Matrix3 to_matrix(const Vector6& a) {
  Matrix3 m;
  m << a[0], a[3], a[5], a[3], a[1], a[4], a[5], a[4], a[2];
  return m;
}

Vector6 to_vector6(const Matrix3& m) {
  Vector6 a;
  a << m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(0, 2);
  return a;
}

}  // namespace furrow
