// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/scm/footprint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

namespace furrow {

namespace {

constexpr double steepest = 1e-6;  // cosine to the vertical of a face that counts as upright
constexpr double smallest =
    1e-12;  // area of a piece over twice that of its triangle, seen from above
constexpr double overfull = 1.0 + 1e-9;

}  // namespace

/// Convex; a triangle cut by four lines has seven corners.
struct Footprint::Polygon {
  int corners = 0;
  std::array<Vector2, 8> x;

  void add(const Vector2& corner) { x[static_cast<std::size_t>(corners++)] = corner; }
  const Vector2& operator[](int corner) const { return x[static_cast<std::size_t>(corner)]; }

  /// The parts on either side of the line where the coordinate has a value.
  void split(int coordinate, double value, Polygon& below, Polygon& above) const {
    below.corners = above.corners = 0;
    for (int k = 0; k < corners; ++k) {
      const Vector2 &here = (*this)[k], &next = (*this)[k + 1 == corners ? 0 : k + 1];
      const double d = here[coordinate] - value, e = next[coordinate] - value;
      if (d <= 0.0) below.add(here);
      if (d >= 0.0) above.add(here);
      if (d * e >= 0.0) continue;
      Vector2 crossing = here + d / (d - e) * (next - here);
      crossing[coordinate] = value;
      below.add(crossing);
      above.add(crossing);
    }
  }
  std::pair<double, double> range(int coordinate) const {
    double lower = x[0][coordinate], upper = lower;
    for (int k = 1; k < corners; ++k) {
      lower = std::min(lower, (*this)[k][coordinate]);
      upper = std::max(upper, (*this)[k][coordinate]);
    }
    return {lower, upper};
  }
};

void Footprint::clear() {
  for (const std::size_t cell : cells_.cell) slot_of_[cell] = -1;
  cells_.cell.clear();
  lowest_.clear();
  pieces_.slot.clear();
  pieces_.triangle.clear();
  pieces_.area.clear();
  pieces_.height.clear();
  pieces_.weight_b.clear();
  pieces_.weight_c.clear();
  pieces_.outline.assign(1, 0);
  pieces_.corners.clear();
}

void Footprint::find(const Surface& body, const HeightField& field) {
  slot_of_.resize(field.cells(), -1);
  clear();
  const double highest = field.highest() + highest_piece * field.cell();
  for (std::size_t t = 0; t < body.triangle_count(); ++t) {
    const Vector3i& nodes = body.triangles[t];
    const double lowest = std::min({body.x(2, nodes[0]), body.x(2, nodes[1]), body.x(2, nodes[2])});
    if (lowest < highest) cut(body, field, static_cast<int>(t));
  }
  drop_high(highest_piece * field.cell());
  drop_covered(field.cell_area());
  find_heights();
}

void Footprint::cut(const Surface& body, const HeightField& field, int triangle) {
  const Vector3 area = body.area_vector(static_cast<std::size_t>(triangle));
  if (-area.z() <= steepest * area.norm()) return;
  const Vector3i& nodes = body.triangles[static_cast<std::size_t>(triangle)];
  std::array<Polygon, 2> rest, row_rest;  // remainder to cut, alternately
  for (int k = 0; k < 3; ++k) rest[0].add(body.x.col(nodes[k]).head<2>());
  const double cell = field.cell();
  const auto place = [&](double value, int axis) {
    return static_cast<int>(std::floor((value - field.lower()[axis]) / cell));
  };
  const auto [x_lower, x_upper] = rest[0].range(0);
  const auto [y_lower, y_upper] = rest[0].range(1);
  const int first = place(x_lower, 0), last = place(x_upper, 0);
  const int first_row = place(y_lower, 1), last_row = place(y_upper, 1);
  if (first < 0 || last >= field.columns() || first_row < 0 || last_row >= field.rows())
    field.refuse_edge(0.5 * Vector2(x_lower + x_upper, y_lower + y_upper));
  if (first == last && first_row == last_row) {
    add(rest[0], field.index(first, first_row), triangle, body);
    return;
  }
  Polygon column, piece;
  std::size_t now = 0;
  for (int i = first; i <= last; ++i) {
    if (i == last) {
      column = rest[now];
    } else {
      rest[now].split(0, field.lower().x() + (i + 1) * cell, column, rest[1 - now]);
      now = 1 - now;
    }
    if (column.corners < 3) continue;
    const auto [lower, upper] = column.range(1);
    const int lowest = place(lower, 1), highest = place(upper, 1);
    std::size_t at = 0;
    row_rest[0] = column;
    for (int j = lowest; j <= highest; ++j) {
      if (j == highest) {
        piece = row_rest[at];
      } else {
        row_rest[at].split(1, field.lower().y() + (j + 1) * cell, piece, row_rest[1 - at]);
        at = 1 - at;
      }
      if (piece.corners >= 3) add(piece, field.index(i, j), triangle, body);
    }
  }
}

void Footprint::add(const Polygon& polygon, std::size_t cell, int triangle, const Surface& body) {
  const Vector3i& nodes = body.triangles[static_cast<std::size_t>(triangle)];
  const Vector3 a = body.x.col(nodes[0]), b = body.x.col(nodes[1]), c = body.x.col(nodes[2]);
  const Vector2 origin = polygon[0];
  double twice = 0.0;
  Vector2 moment = Vector2::Zero();  // about the first corner, times 6
  for (int k = 1; k + 1 < polygon.corners; ++k) {
    const Vector2 u = polygon[k] - origin, v = polygon[k + 1] - origin;
    const double part = u.x() * v.y() - u.y() * v.x();
    twice += part;
    moment += part * (u + v);
  }
  const double area = 0.5 * std::abs(twice);
  const Vector2 ab = (b - a).head<2>(), ac = (c - a).head<2>();
  const double whole = ab.x() * ac.y() - ab.y() * ac.x();
  if (!(area > smallest * std::abs(whole))) return;
  const Vector2 centroid = origin + moment / (3.0 * twice) - a.head<2>();
  const double weight_b = (centroid.x() * ac.y() - centroid.y() * ac.x()) / whole;
  const double weight_c = (ab.x() * centroid.y() - ab.y() * centroid.x()) / whole;
  int& slot = slot_of_[cell];
  if (slot < 0) {
    slot = static_cast<int>(cells_.size());
    cells_.cell.push_back(cell);
    lowest_.push_back(std::numeric_limits<double>::infinity());
  }
  const double height = a.z() + weight_b * (b.z() - a.z()) + weight_c * (c.z() - a.z());
  double& lowest = lowest_[static_cast<std::size_t>(slot)];
  lowest = std::min(lowest, height);
  pieces_.slot.push_back(slot);
  pieces_.triangle.push_back(triangle);
  pieces_.area.push_back(area);
  pieces_.height.push_back(height);
  pieces_.weight_b.push_back(weight_b);
  pieces_.weight_c.push_back(weight_c);
  for (int k = 0; k < polygon.corners; ++k) pieces_.corners.push_back(polygon[k]);
  pieces_.outline.push_back(pieces_.corners.size());
}

/// Keeps only the foot of a steep face over a cell.
void Footprint::drop_high(double allowed) {
  cells_.area.assign(cells_.size(), 0.0);
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    const auto s = static_cast<std::size_t>(pieces_.slot[p]);
    if (pieces_.height[p] > lowest_[s] + allowed) pieces_.area[p] = 0.0;
    cells_.area[s] += pieces_.area[p];
  }
}

void Footprint::drop_covered(double cell_area) {
  const auto cell_of = [&](std::size_t p) { return static_cast<std::size_t>(pieces_.slot[p]); };
  order_.clear();
  for (std::size_t p = 0; p < pieces_.size(); ++p)
    if (cells_.area[cell_of(p)] > overfull * cell_area) order_.push_back(p);
  const auto key = [&](std::size_t p) {
    return std::make_tuple(pieces_.slot[p], pieces_.height[p], p);
  };
  std::sort(order_.begin(), order_.end(),
            [&](std::size_t p, std::size_t q) { return key(p) < key(q); });
  double room = 0.0;
  for (std::size_t k = 0; k < order_.size(); ++k) {
    const std::size_t p = order_[k], s = cell_of(p);
    if (k == 0 || s != cell_of(order_[k - 1])) room = cells_.area[s] = cell_area;
    pieces_.area[p] = std::min(pieces_.area[p], room);
    room -= pieces_.area[p];
  }
}

void Footprint::find_heights() {
  cells_.height.assign(cells_.size(), 0.0);
  for (std::size_t p = 0; p < pieces_.size(); ++p)
    cells_.height[static_cast<std::size_t>(pieces_.slot[p])] += pieces_.area[p] * pieces_.height[p];
  for (std::size_t s = 0; s < cells_.size(); ++s) cells_.height[s] /= cells_.area[s];
}

}  // namespace furrow
