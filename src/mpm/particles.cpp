// SPDX-License-Identifier: GPL-2.0-or-later
#include "mpm/particles.h"

#include <algorithm>

namespace furrow {

Particles::Particles(const Material& material) : state_fields_(material.state_fields().size()) {
  for (std::size_t c = 0; c < column::state + state_fields_; ++c)
    add_column(c == column::velocity ? 4 : c == column::affine ? 12 : 1);
}

std::size_t Particles::add_column(int components) {
  columns_.push_back(
      {components, std::vector<double>(size_ * static_cast<std::size_t>(components), 0.0)});
  return columns_.size() - 1;
}

std::size_t Particles::record_length() const {
  std::size_t length = 0;
  for (const Column& c : columns_) length += static_cast<std::size_t>(c.components);
  return length;
}

Matrix3 Particles::affine(std::size_t i) const {
  return Eigen::Map<const Eigen::Matrix<double, 4, 3>>(data(column::affine) + 12 * i).topRows<3>();
}

std::size_t Particles::append(std::size_t count) {
  const std::size_t first = size_;
  size_ += count;
  for (Column& c : columns_) c.values.resize(size_ * static_cast<std::size_t>(c.components), 0.0);
  return first;
}

void Particles::set_state(std::size_t i, const VectorX& state) {
  for (std::size_t f = 0; f < state_fields_; ++f)
    data(column::state + f)[i] = state[static_cast<Eigen::Index>(f)];
}

VectorX Particles::state(std::size_t i) const {
  VectorX state(static_cast<Eigen::Index>(state_fields_));
  for (std::size_t f = 0; f < state_fields_; ++f)
    state[static_cast<Eigen::Index>(f)] = data(column::state + f)[i];
  return state;
}

void Particles::reorder(const std::vector<std::size_t>& order) {
  for (Column& c : columns_) {
    const auto n = static_cast<std::size_t>(c.components);
    scratch_.resize(order.size() * n);
    for (std::size_t i = 0; i < order.size(); ++i)
      std::copy_n(c.values.data() + n * order[i], n, scratch_.data() + n * i);
    c.values.swap(scratch_);
  }
  size_ = order.size();
}

void Particles::pack(std::size_t i, std::vector<double>& buffer) const {
  for (const Column& c : columns_) {
    const auto n = static_cast<std::size_t>(c.components);
    buffer.insert(buffer.end(), c.values.data() + n * i, c.values.data() + n * (i + 1));
  }
}

void Particles::unpack(const double* record) {
  ++size_;
  for (Column& c : columns_) {
    c.values.insert(c.values.end(), record, record + c.components);
    record += c.components;
  }
}

ParticleView Particles::view(std::size_t first, std::size_t count) {
  ParticleView view;
  view.size = count;
  for (std::size_t a = 0; a < 3; ++a) {
    view.shape_position[a] = data(column::shape_x + a) + first;
    view.position[a] = data(column::x + a) + first;
  }
  view.velocity = data(column::velocity) + 4 * first;
  view.affine = data(column::affine) + 12 * first;
  view.volume = data(column::volume) + first;
  view.volume_ratio = data(column::state + field::volume_ratio) + first;
  for (std::size_t s = 0; s < 6; ++s)
    view.stress[s] = data(column::state + field::stress + s) + first;
  return view;
}

void Particles::state_pointers(std::size_t first, std::vector<double*>& pointers) {
  pointers.resize(state_fields_);
  for (std::size_t f = 0; f < state_fields_; ++f) pointers[f] = data(column::state + f) + first;
}

}  // namespace furrow
