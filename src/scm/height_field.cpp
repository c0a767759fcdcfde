// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/scm/height_field.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/options/check_number.h"
#include "furrow/core/error.h"
#include "furrow/geometry/bilinear.h"

namespace furrow {

namespace {

constexpr double round_off = 1e-9;     // of a cell
constexpr double maximum_cells = 4e8;  // 16 bytes each

/// Whole cells, at least as long as the length.
int cells_in(double length, double cell) {
  return std::max(1, static_cast<int>(std::ceil(length / cell - round_off)));
}

}  // namespace

void declare_height_field(Schema& schema) {
  schema.number("length", "m", Range::positive(), "length of the ground along x");
  schema.number("width", "m", Range::positive(), "width of the ground along y");
  schema.numbers("centre", 2, "m", Range::any(), "x y of the middle")
      .by_default(std::vector<double>{0.0, 0.0});
  schema.number("surface", "m", Range::any(), "z of the undisturbed surface").by_default(0.0);
  schema.number("cell", "m", Range::positive(), "edge of the square cells");
}

HeightFieldParameters height_field_from(const Options& options) {
  HeightFieldParameters field;
  field.length = options.number("length");
  field.width = options.number("width");
  field.centre = Vector2(options.numbers("centre")[0], options.numbers("centre")[1]);
  field.level = options.number("surface");
  field.cell = options.number("cell");
  return field;
}

HeightField::HeightField(const HeightFieldParameters& parameters, const std::string& where)
    : parameters_(parameters), highest_(parameters.level) {
  const auto check = [&](double value, const char* key) {
    check_number(value, Range::positive(), fmt::format("{}, keyword '{}'", where, key), "m");
  };
  check(parameters.length, "length");
  check(parameters.width, "width");
  check(parameters.cell, "cell");
  const double side = std::min(parameters.length, parameters.width);
  need(parameters.cell <= side, where + ", keyword 'cell'",
       fmt::format("is {:g} m, and the ground {:g} m x {:g} m", parameters.cell, parameters.length,
                   parameters.width),
       fmt::format("at most {:g} m", side), "give all in m, and at least 4 cells across a wheel");
  const double count = parameters.length / parameters.cell * (parameters.width / parameters.cell);
  need(count <= maximum_cells, where + ", keyword 'cell'",
       fmt::format("is {:g} m, which makes {:.3g} cells", parameters.cell, count),
       fmt::format("at most {:g} cells", maximum_cells), "every rank keeps all of them");
  columns_ = cells_in(parameters.length, parameters.cell);
  rows_ = cells_in(parameters.width, parameters.cell);
  lower_ = parameters.centre - 0.5 * parameters.cell * Vector2(columns_, rows_);
  const auto size = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  surface_.assign(size, parameters.level);
  reference_.assign(size, parameters.level);
  if (parameters.relief.flat()) return;
  parameters.relief.check_map(lower_, lower_ + parameters.cell * Vector2(columns_, rows_));
  undisturbed_.resize(size);
  for (int column = 0; column < columns_; ++column) {
    const double x = lower_.x() + parameters.cell * (column + 0.5);
    const double height = parameters.level + parameters.relief.profile(x);
    for (int row = 0; row < rows_; ++row) {
      const double y = lower_.y() + parameters.cell * (row + 0.5);
      undisturbed_[index(column, row)] = height + parameters.relief.map_height(x, y);
    }
  }
  surface_ = reference_ = undisturbed_;
  const auto [lowest, highest] = std::minmax_element(surface_.begin(), surface_.end());
  highest_ = *highest;
  need(*highest - *lowest <= parameters.length, where,
       fmt::format("has heights from {:.4g} to {:.4g} m over a length of {:.4g} m", *lowest,
                   *highest, parameters.length),
       "heights that differ by less than the length", "give all lengths and heights in m");
}

double HeightField::height(const Vector2& place) const {
  return bilinear(place, lower_ + Vector2::Constant(0.5 * cell()), Vector2::Constant(cell()),
                  columns_, rows_,
                  [&](int column, int row) { return surface_[index(column, row)]; });
}

void HeightField::refuse_edge(const Vector2& place) const {
  const Vector2 last = upper();
  throw StateError(fmt::format(
      "the body reaches the edge of the height field at x = {:.4g} m, y = {:.4g} m: the field "
      "spans {:.4g} to {:.4g} m and {:.4g} to {:.4g} m; make it longer or wider",
      place.x(), place.y(), lower_.x(), last.x(), lower_.y(), last.y()));
}

void HeightField::raise(std::size_t cell, double height) {
  surface_[cell] += height;
  reference_[cell] += height;
  highest_ = std::max(highest_, surface_[cell]);
}

void HeightField::deposit(int column, int row, int direction, double height, double slope) {
  raise(index(column, row), height);
  for (int next = row + direction; next >= 0 && next < rows_; row = next, next += direction) {
    const std::size_t here = index(column, row), there = index(column, next);
    const double excess = surface_[here] - surface_[there] - slope * cell();
    if (excess <= 0.0) return;
    raise(here, -0.5 * excess);
    raise(there, 0.5 * excess);
  }
}

double HeightField::deepest() const {
  double deepest = 0.0;
  for (std::size_t c = 0; c < cells(); ++c)
    deepest = std::max(deepest, reference_[c] - surface_[c]);
  return deepest;
}

double HeightField::volume_above() const {
  double sum = 0.0;
  for (std::size_t c = 0; c < cells(); ++c) sum += std::max(0.0, surface_[c] - undisturbed(c));
  return sum * cell_area();
}

double HeightField::volume_below() const {
  double sum = 0.0;
  for (std::size_t c = 0; c < cells(); ++c) sum += std::max(0.0, undisturbed(c) - surface_[c]);
  return sum * cell_area();
}

Surface HeightField::triangles() const {
  Surface mesh;
  mesh.resize(cells());
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      const std::size_t c = index(column, row);
      const Vector2 centre = lower_ + cell() * Vector2(column + 0.5, row + 0.5);
      mesh.x.col(static_cast<Eigen::Index>(c)) << centre, surface_[c];
      if (row + 1 == rows_ || column + 1 == columns_) continue;
      const int a = static_cast<int>(c), b = a + 1, d = a + columns_, e = d + 1;
      mesh.triangles.emplace_back(a, b, e);
      mesh.triangles.emplace_back(a, e, d);
    }
  return mesh;
}

void HeightField::checkpoint(Checkpoint& state) {
  state.match("columns", columns_);
  state.match("rows", rows_);
  state.match("cell", parameters_.cell);
  state.match("level", parameters_.level);
  parameters_.relief.match(state);
  state.values("surface", surface_);
  state.values("reference", reference_);
  state.value("highest", highest_);
}

}  // namespace furrow
