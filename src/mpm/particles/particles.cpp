// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/particles/particles.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

int components_of(std::size_t column) {
  switch (column) {
    case column::velocity:
      return 4;
    case column::affine:
      return 12;
    case column::residual:
      return 8;
    default:
      return 1;
  }
}

}  // namespace

Particles::AddedValues::AddedValues(std::shared_ptr<AddedColumn> column)
    : column_(std::move(column)) {
  column_->owner = AddedColumn::Owner::present;
}

Particles::AddedValues::~AddedValues() {
  if (column_) column_->owner = AddedColumn::Owner::gone;
}

Particles::Particles(const Material& material) : state_fields_(material.state_fields().size()) {
  for (std::size_t c = 0; c < column::state + state_fields_; ++c) {
    const int components = components_of(c);
    columns_.push_back({components, zeros(components)});
  }
}

Particles::AddedValues Particles::add_column(const std::string& owner, int components,
                                             bool (*idle)(const double* values)) {
  remove_released_columns();
  const auto found = std::find_if(added_.begin(), added_.end(),
                                  [&](const auto& column) { return column->name == owner; });
  if (found == added_.end()) {
    added_.push_back(std::make_shared<AddedColumn>(
        AddedColumn{{components, zeros(components)}, owner, AddedColumn::Owner::present, idle}));
    return AddedValues(added_.back());
  }
  AddedColumn& column = **found;
  if (column.owner == AddedColumn::Owner::present)
    throw Error(fmt::format("{} keeps values with these particles already", owner));
  if (column.components != components)
    throw Error(fmt::format("{} keeps {} values with a particle, the checkpoint has {}", owner,
                            components, column.components));
  column.idle = idle;
  return AddedValues(*found);
}

void Particles::remove_released_columns() {
  added_.erase(
      std::remove_if(added_.begin(), added_.end(),
                     [](const auto& column) { return column->owner == AddedColumn::Owner::gone; }),
      added_.end());
}

/// Columns that are there already must be the first of the checkpoint's, in its order.
void Particles::checkpoint_columns(Checkpoint& state) {
  remove_released_columns();
  auto count = static_cast<std::int64_t>(added_.size());
  const std::int64_t present = count;
  state.value("added_columns", count);
  if (present > count)
    throw Error(fmt::format("{}: the checkpoint has no values that {} keeps with the particles",
                            state.owner(), added_[static_cast<std::size_t>(count)]->name));
  for (std::size_t n = 0; n < static_cast<std::size_t>(count); ++n) {
    const bool exists = n < added_.size();
    std::string owner = exists ? added_[n]->name : "";
    int components = exists ? added_[n]->components : 0;
    state.value("values_kept_by", owner);
    state.value("their_number", components);
    if (!exists)
      added_.push_back(std::make_shared<AddedColumn>(AddedColumn{
          {components, zeros(components)}, owner, AddedColumn::Owner::absent, nullptr}));
    else if (owner != added_[n]->name || components != added_[n]->components)
      throw Error(fmt::format(
          "{}: {} keeps values with its particles, {} did when the checkpoint was written",
          state.owner(), added_[n]->name, owner));
  }
}

std::size_t Particles::place_in_record(std::size_t column) {
  std::size_t place = 0;
  for (std::size_t c = 0; c < column; ++c) place += static_cast<std::size_t>(components_of(c));
  return place;
}

std::size_t Particles::record_length() const {
  std::size_t length = 0;
  for_each_column([&](const Column& c) { length += static_cast<std::size_t>(c.components); });
  return length;
}

Matrix3 Particles::affine(std::size_t i) const {
  return Eigen::Map<const Eigen::Matrix<double, 4, 3>>(data(column::affine) + 12 * i).topRows<3>();
}

std::size_t Particles::append(std::size_t count) {
  const std::size_t first = size_;
  size_ += count;
  for_each_column(
      [&](Column& c) { c.values.resize(size_ * static_cast<std::size_t>(c.components), 0.0); });
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

bool Particles::is_idle(std::size_t i) const {
  return std::all_of(added_.begin(), added_.end(), [i](const auto& column) {
    return !column->idle ||
           column->idle(column->values.data() + static_cast<std::size_t>(column->components) * i);
  });
}

std::size_t Particles::duplicate(std::size_t i) {
  std::vector<double> record;
  pack(i, record);
  unpack(record.data());
  return size_ - 1;
}

void Particles::average(std::size_t i, std::size_t other) {
  for (Column& column : columns_) {
    const auto n = static_cast<std::size_t>(column.components);
    for (std::size_t c = 0; c < n; ++c) {
      double& value = column.values[n * i + c];
      value = 0.5 * (value + column.values[n * other + c]);
    }
  }
}

/// Many particles that keep their place, at both ends, are not touched: those of
/// ground at rest.
void Particles::reorder(const std::vector<std::size_t>& order) {
  if (order.size() == size_) {
    std::size_t first = 0, last = size_;
    while (first < last && order[first] == first) ++first;
    while (last > first && order[last - 1] == last - 1) --last;
    if (2 * (last - first) < size_) {
      reorder_some(order, first, last);
      return;
    }
  }
  for_each_column([&](Column& c) {
    if (c.components == 1) {
      scratch_.resize(order.size());
      for (std::size_t i = 0; i < order.size(); ++i) scratch_[i] = c.values[order[i]];
      c.values.swap(scratch_);
    } else {
      c.values = rows_of(c, order, 0, order.size());
    }
  });
  size_ = order.size();
}

void Particles::reorder_some(const std::vector<std::size_t>& order, std::size_t first,
                             std::size_t last) {
  for_each_column([&](Column& c) {
    const std::vector<double> moved = rows_of(c, order, first, last);
    std::copy(moved.begin(), moved.end(),
              c.values.data() + static_cast<std::size_t>(c.components) * first);
  });
}

/// Values of the particles order[first] ... order[last - 1]. Not in scratch_: columns swap with it,
/// and all would get the memory of the column with most components.
std::vector<double> Particles::rows_of(const Column& column, const std::vector<std::size_t>& order,
                                       std::size_t first, std::size_t last) {
  const auto n = static_cast<std::size_t>(column.components);
  std::vector<double> rows;
  rows.reserve((last - first) * n);
  for (std::size_t i = first; i < last; ++i) {
    const double* row = column.values.data() + n * order[i];
    rows.insert(rows.end(), row, row + n);
  }
  return rows;
}

void Particles::pack(std::size_t i, std::vector<double>& buffer) const {
  for_each_column([&](const Column& c) {
    const auto n = static_cast<std::size_t>(c.components);
    buffer.insert(buffer.end(), c.values.data() + n * i, c.values.data() + n * (i + 1));
  });
}

void Particles::unpack(const double* record) {
  ++size_;
  for_each_column([&](Column& c) {
    c.values.insert(c.values.end(), record, record + c.components);
    record += c.components;
  });
}

void Particles::reserve(std::size_t count) {
  for_each_column(
      [&](Column& c) { c.values.reserve(count * static_cast<std::size_t>(c.components)); });
}

void Particles::clear() {
  for_each_column([](Column& c) { c.values = std::vector<double>(); });
  scratch_ = std::vector<double>();
  size_ = 0;
}

ParticleView Particles::view(std::size_t first, std::size_t count) {
  ParticleView view;
  view.size = count;
  for (std::size_t a = 0; a < 3; ++a) {
    view.quadrature_position[a] = data(column::quadrature_x + a) + first;
    view.position[a] = data(column::x + a) + first;
  }
  view.velocity = data(column::velocity) + 4 * first;
  view.affine = data(column::affine) + 12 * first;
  view.residual = data(column::residual) + 8 * first;
  view.cell = data(column::cell) + first;
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
