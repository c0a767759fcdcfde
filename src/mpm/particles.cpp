// SPDX-License-Identifier: GPL-2.0-or-later
#include "mpm/particles.h"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "core/error.h"

namespace furrow {

Particles::Particles(const Material& material) : state_fields_(material.state_fields().size()) {
  for (std::size_t c = 0; c < column::state + state_fields_; ++c)
    append_column("", c == column::velocity ? 4 : c == column::affine ? 12 : 1, true);
}

std::size_t Particles::append_column(const std::string& owner, int components, bool claimed) {
  columns_.push_back({components,
                      std::vector<double>(size_ * static_cast<std::size_t>(components), 0.0), owner,
                      claimed});
  return columns_.size() - 1;
}

std::size_t Particles::add_column(const std::string& owner, int components) {
  const auto found = std::find_if(columns_.begin(), columns_.end(),
                                  [&](const Column& column) { return column.owner == owner; });
  if (found == columns_.end()) return append_column(owner, components, true);
  if (found->claimed)
    throw Error(fmt::format("{} keeps values with these particles already", owner));
  if (found->components != components)
    throw Error(fmt::format("{} keeps {} values with a particle, the checkpoint has {}", owner,
                            components, found->components));
  found->claimed = true;
  return static_cast<std::size_t>(found - columns_.begin());
}

/// Columns that are there already must be the first of the checkpoint's, in its order.
void Particles::checkpoint_columns(Checkpoint& state) {
  const std::size_t own = column::state + state_fields_;
  auto added = static_cast<std::int64_t>(columns_.size() - own);
  const std::int64_t present = added;
  state.value("added_columns", added);
  if (present > added)
    throw Error(fmt::format("{}: the checkpoint has no values that {} keeps with the particles",
                            state.owner(), columns_[own + static_cast<std::size_t>(added)].owner));
  for (std::size_t n = 0; n < static_cast<std::size_t>(added); ++n) {
    const bool exists = own + n < columns_.size();
    std::string owner = exists ? columns_[own + n].owner : "";
    int components = exists ? columns_[own + n].components : 0;
    state.value("values_kept_by", owner);
    state.value("their_number", components);
    if (!exists)
      append_column(owner, components, false);
    else if (owner != columns_[own + n].owner || components != columns_[own + n].components)
      throw Error(fmt::format(
          "{}: {} keeps values with its particles, {} did when the checkpoint was written",
          state.owner(), columns_[own + n].owner, owner));
  }
}

std::vector<std::string> Particles::unclaimed_columns() const {
  std::vector<std::string> owners;
  for (const Column& column : columns_)
    if (!column.claimed) owners.push_back(column.owner);
  return owners;
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
