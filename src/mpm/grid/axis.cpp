// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/grid/axis.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

// ratio of neighbouring cells: a coarser grading reflects waves
constexpr double max_growth = 1.5;

/// Lengths of cells from the fine stretch outwards in any unit, and their sum.
struct Tail {
  std::vector<double> lengths;
  double sum = 0.0;
};

/// Cells over a distance, each longer than the last by `growth`.
Tail growing_cells(double distance, double cell, double growth) {
  Tail tail;
  for (double length = cell * growth; tail.sum < distance * (1.0 - 1e-9); length *= growth) {
    tail.lengths.push_back(length);
    tail.sum += length;
  }
  // One cell less if this is nearer: the cells are then stretched instead of shrunk.
  if (tail.lengths.size() > 1 &&
      distance - (tail.sum - tail.lengths.back()) < tail.sum - distance) {
    tail.sum -= tail.lengths.back();
    tail.lengths.pop_back();
  }
  return tail;
}

/// AxisLayout::stepped over a number of fine cells, from the longest inwards: each cell has the
/// length of the one before or the next shorter one. Cells of 3/2 come in pairs.
Tail stepped_cells(double distance, double growth) {
  std::vector<double> steps = {1.0, 1.5, 2.0};    // lengths
  std::vector<double> shorter = {0.0, 0.0, 3.0};  // distance for one of each shorter length
  while (steps.back() < distance) {
    shorter.push_back(shorter.back() + steps.back());
    steps.push_back(2.0 * steps[steps.size() - 2]);
  }
  const auto cells_of = [](std::size_t step) { return step == 1 ? 2.0 : 1.0; };
  Tail tail;
  std::size_t step = steps.size() - 1, shortest = 0;
  while (tail.sum < distance - 0.5) {
    const double left = distance - tail.sum;
    const auto fits = [&](std::size_t n) {
      return steps[n] <= 1.0 + std::log(growth) * (left - 0.5 * steps[n]) &&
             cells_of(n) * steps[n] + shorter[n] <= left;
    };
    while (step > shortest && !fits(step)) --step;
    tail.lengths.insert(tail.lengths.begin(), static_cast<std::size_t>(cells_of(step)),
                        steps[step]);
    tail.sum += cells_of(step) * steps[step];
    shortest = step == 0 ? 0 : step - 1;
  }
  return tail;
}

/// Ends of the cells from `start` outwards over `distance` in the direction `sign`; all are
/// stretched by one factor so that the last ends there.
std::vector<double> ends_of_tail(const AxisLayout& layout, double start, double distance,
                                 double cell, double sign) {
  const Tail tail = layout.stepped ? stepped_cells(std::round(distance / cell), layout.growth)
                                   : growing_cells(distance, cell, layout.growth);
  std::vector<double> ends;
  double end = 0.0;
  for (const double length : tail.lengths)
    ends.push_back(start + sign * (end += length) * (distance / tail.sum));
  return ends;
}

constexpr double edge_growth = 1.4;
constexpr double edge_cells = 3.0;  // of equal length, on each side of an edge

/// Length of the cells at a place [m], if they need not fit between the ends. Cells that grow by a
/// factor g have lengths whose slope is ln g.
double wanted_length(const AxisLayout& layout, double x) {
  const double outside = std::max({layout.fine_lower - x, x - layout.fine_upper, 0.0});
  double length = layout.cell + std::log(layout.growth) * outside;
  for (const double edge : layout.edges) {
    const double distance = std::abs(x - edge) - edge_cells * layout.edge_cell;
    length = std::min(length, layout.edge_cell + std::log(edge_growth) * std::max(0.0, distance));
  }
  return length;
}

/// Ends of the cells between two knots, whose lengths follow wanted_length(); with the upper knot.
std::vector<double> cells_between(const AxisLayout& layout, double lower, double upper) {
  // cells per length, summed by the trapezoidal rule in parts that are much shorter than a cell
  const int parts = static_cast<int>(std::ceil(64.0 * (upper - lower) / layout.edge_cell));
  const double part = (upper - lower) / parts;
  std::vector<double> sum = {0.0};
  double last = 1.0 / wanted_length(layout, lower);
  for (int i = 1; i <= parts; ++i) {
    const double next = 1.0 / wanted_length(layout, lower + i * part);
    sum.push_back(sum.back() + 0.5 * part * (last + next));
    last = next;
  }
  const int cells = std::max(1, static_cast<int>(std::lround(sum.back())));
  std::vector<double> ends;
  for (int c = 1, i = 1; c < cells; ++c) {
    const double wanted = sum.back() * c / cells;
    while (sum[static_cast<std::size_t>(i)] < wanted) ++i;
    const double above = sum[static_cast<std::size_t>(i)],
                 below = sum[static_cast<std::size_t>(i - 1)];
    ends.push_back(lower + part * (i - (above - wanted) / (above - below)));
  }
  ends.push_back(upper);
  return ends;
}

/// Knots of an axis with a knot at each edge.
std::vector<double> knots_with_edges(const AxisLayout& layout) {
  std::vector<double> knots = {layout.lower};
  std::vector<double> ends = layout.edges;
  std::sort(ends.begin(), ends.end());
  ends.push_back(layout.upper);
  for (const double end : ends) {
    if (end <= knots.back() || end > layout.upper) continue;
    for (const double knot : cells_between(layout, knots.back(), end)) knots.push_back(knot);
  }
  return knots;
}

}  // namespace

Axis::Axis(const AxisLayout& layout, const std::string& where) {
  const double lower = std::max(layout.lower, layout.fine_lower);
  const double upper = std::min(layout.upper, layout.fine_upper);
  if (!(layout.upper > layout.lower) || !(layout.cell > 0.0) || !(upper > lower))
    throw InputError(
        where,
        fmt::format("has cells of {} m from {} to {} m, fine from {} to {} m", layout.cell,
                    layout.lower, layout.upper, layout.fine_lower, layout.fine_upper),
        "lower < upper, a cell > 0, and a fine stretch that is not empty");
  if (!(layout.growth >= 1.0 && layout.growth <= max_growth))
    throw InputError(where, fmt::format("has cells that grow by {}", layout.growth),
                     fmt::format("1 to {}", max_growth), "coarser steps reflect waves");
  const int fine = std::max(1, static_cast<int>(std::lround((upper - lower) / layout.cell)));
  const double cell = (upper - lower) / fine;
  for (const double end : ends_of_tail(layout, lower, lower - layout.lower, cell, -1.0))
    knot_.insert(knot_.begin(), end);
  for (int i = 0; i <= fine; ++i) knot_.push_back(lower + i * cell);
  for (const double end : ends_of_tail(layout, upper, layout.upper - upper, cell, 1.0))
    knot_.push_back(end);
  knot_.front() = layout.lower;
  knot_.back() = layout.upper;
  if (!layout.edges.empty()) knot_ = knots_with_edges(layout);
  initial_knot_ = knot_;
  tabulate();
  shortest_at_start_ = shortest_;
  fine_cell_ = uniform_ ? (knot_.back() - knot_.front()) / cells() : cell;
}

double Axis::cell_count(const AxisLayout& layout) {
  if (!layout.edges.empty()) return static_cast<double>(knots_with_edges(layout).size() - 1);
  const double lower = std::max(layout.lower, layout.fine_lower),
               upper = std::min(layout.upper, layout.fine_upper);
  const double fine = std::max(1.0, std::round((upper - lower) / layout.cell));
  const double cell = (upper - lower) / fine, growth = layout.growth;
  double count = fine;
  for (const double distance : {lower - layout.lower, layout.upper - upper}) {
    if (!(distance > 0.0)) continue;
    if (layout.stepped) {
      count +=
          static_cast<double>(stepped_cells(std::round(distance / cell), growth).lengths.size());
      continue;
    }
    // cell (growth + growth^2 + ... + growth^n) = distance
    const double cells = distance / cell;
    count += growth > 1.0 ? std::log1p(cells * (growth - 1.0) / growth) / std::log(growth) : cells;
  }
  return count;
}

void Axis::tabulate() {
  const int n = cells();
  const auto at = [&](int i) { return knot(std::clamp(i, 0, n)); };
  left_.resize(static_cast<std::size_t>(n));
  right_.resize(left_.size());
  node_.clear();
  double longest = 0.0;
  shortest_ = length(0);
  for (int c = 0; c < n; ++c) {
    left_[static_cast<std::size_t>(c)] = 1.0 / ((at(c + 1) - at(c - 1)) * length(c));
    right_[static_cast<std::size_t>(c)] = 1.0 / ((at(c + 2) - at(c)) * length(c));
    shortest_ = std::min(shortest_, length(c));
    longest = std::max(longest, length(c));
  }
  for (int i = 0; i < n + 2; ++i) node_.push_back(0.5 * (at(i - 1) + at(i)));
  irregular_.clear();
  for (int c = 0; c < n; ++c)
    irregular_.push_back(c == 0 || c == n - 1 ||
                                 std::max(std::abs(length(c - 1) - length(c)),
                                          std::abs(length(c + 1) - length(c))) > 1e-9 * length(c)
                             ? 1
                             : 0);
  regular_from_ = regular_to_ = 0;
  for (int from = 0, c = 0; c <= n; ++c) {
    if (c < n && irregular_[static_cast<std::size_t>(c)] == 0) continue;
    if (c - from > regular_to_ - regular_from_) {
      regular_from_ = from;
      regular_to_ = c;
    }
    from = c + 1;
  }
  uniform_ = longest - shortest_ < 1e-9 * longest;
  const int bins = static_cast<int>(std::ceil((upper() - lower()) / shortest_ * (1.0 - 1e-12))) + 1;
  bins_per_length_ = bins / (upper() - lower());
  cell_of_bin_.clear();
  for (int b = 0, c = 0; b < bins; ++b) {
    while (c + 1 < n && knot(c + 1) <= lower() + b / bins_per_length_) ++c;
    cell_of_bin_.push_back(c);
  }
}

double Axis::extent(int i) const {
  const int n = cells();
  return (knot(std::clamp(i + 1, 0, n)) - knot(std::clamp(i - 2, 0, n))) / 3.0;
}

int Axis::cell_of(double x) const {
  if (!(x >= lower() && x <= upper())) return -1;
  const auto bin =
      std::min(static_cast<std::size_t>((x - lower()) * bins_per_length_), cell_of_bin_.size() - 1);
  int cell = cell_of_bin_[bin];
  while (cell + 1 < cells() && x >= knot(cell + 1)) ++cell;
  return cell;
}

AxisView Axis::view() const {
  AxisView view;
  view.cells = cells();
  view.lower = lower();
  view.particles_lower = lower();
  view.particles_upper = upper();
  view.bins = static_cast<int>(cell_of_bin_.size());
  view.bins_per_length = bins_per_length_;
  view.cell_of_bin = cell_of_bin_.data();
  view.knot = knot_.data();
  view.left = left_.data();
  view.right = right_.data();
  view.node = node_.data();
  view.irregular = irregular_.data();
  view.regular_from = regular_from_;
  view.regular_to = regular_to_;
  view.regular_start = knot(regular_from_);
  view.regular_length = length(regular_from_);
  return view;
}

void Axis::shift(int count) {
  if (count == 0) return;
  shifted_ += count;
  const double distance = shifted_ * fine_cell_;
  for (std::size_t i = 0; i < knot_.size(); ++i) knot_[i] = initial_knot_[i] + distance;
  tabulate();
}

}  // namespace furrow
