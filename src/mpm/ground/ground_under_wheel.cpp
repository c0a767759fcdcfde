// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/ground/ground_under_wheel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace furrow {

namespace {

constexpr double digit_round_off = 1e-9;

// Cells in a length. Wheel: a seventh of its width suffices for pull and torque (study
// convergence), an eighth leaves room for cells longer along an axis. Radius and depth: with fewer
// a run warns.
constexpr double cells_of_a_wheel = 8.0, cells_of_the_radius = 4.0, cells_of_the_depth = 4.0;
// Grouser in ground that does not move apart: a thin blade pushes 57 % too hard in 3 cells, 39 % in
// 6 (study convergence). Groove: a B-spline spans three cells, and bridges a narrower one.
constexpr double cells_of_an_undivided_grouser = 5.0, cells_of_a_groove = 3.0;
// Widths of the wheel below which cells may grow: measured in guide/howto/fine_cells.md. In fewer
// cells below, growing ones save none or are shorter than fine ones.
constexpr double fine_widths = 1.1, cells_to_grow = 5.0;

/// Factor from a length to a number with two digits before the point.
double two_digits(double value) { return std::pow(10.0, 1.0 - std::floor(std::log10(value))); }

double rounded_down(double value) {
  const double digits = two_digits(value);
  return std::floor(value * digits + digit_round_off) / digits;
}

}  // namespace

double rounded_up(double value) {
  const double digits = two_digits(value);
  return std::ceil(value * digits - digit_round_off) / digits;
}

GroundSize ground_under_wheel(double radius, double width, double depth) {
  const double sunk = std::min(depth, radius);
  const double half_chord = std::sqrt(sunk * (2.0 * radius - sunk));
  return {rounded_up(2.0 * (half_chord + depth)), rounded_up(width + 2.0 * depth),
          rounded_up(width + 0.5 * depth)};
}

WheelDetails details_of(const WheelHub& wheel) {
  WheelDetails details{wheel.nominal_radius(), wheel.nominal_width(), wheel.narrowest_groove()};
  const double high = wheel.tip_radius() - wheel.nominal_radius();
  if (wheel.grousers() == 0 || high <= 0.0) return details;
  details.grouser_height = high;
  details.grouser_spacing = 2.0 * pi * wheel.nominal_radius() / wheel.grousers();
  return details;
}

void choose_cell(GroundSize& size, const WheelDetails& wheel, double depth, bool thin_parts) {
  const std::pair<double, const char*> limits[] = {
      {wheel.width / cells_of_a_wheel, "the wheel's width"},
      {wheel.radius / cells_of_the_radius, "the wheel's radius"},
      {depth / cells_of_the_depth, "the depth"},
      {wheel.grouser_height / (thin_parts ? cells_of_a_grouser : cells_of_an_undivided_grouser),
       "the height of the grousers"},
      {wheel.grouser_spacing / cells_of_a_grouser, "the spacing of the grousers"},
      {wheel.groove / cells_of_a_groove, "the grooves of the tread"}};
  const auto& [limit, by] =
      *std::min_element(std::begin(limits), std::end(limits),
                        [](const auto& a, const auto& b) { return a.first < b.first; });
  size.cell = rounded_down(limit);
  size.cell_by = by;
  const double fine =
      size.cell * std::ceil(fine_widths * wheel.width / size.cell - digit_round_off);
  if (depth - fine >= cells_to_grow * size.cell)
    size.fine_depth = fine;
  else  // whole cells fill the depth, none of them longer
    size.cell = rounded_down(depth / std::ceil(depth / size.cell - digit_round_off));
}

std::optional<CellError> cell_error(GroundKind kind) {
  switch (kind) {
    case GroundKind::sand:
      return CellError{0.087, 0.046};
    case GroundKind::snow:
      return CellError{0.088, 0.036};
    default:
      return {};
  }
}

}  // namespace furrow
