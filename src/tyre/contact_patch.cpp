// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/contact_patch.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace furrow {

namespace {

/// Where the outline ends beyond a touching node: the farther of two ends, each below the truth for
/// the other's gap. One is for a gap that grows as the square of the distance from the edge, the
/// other for one that goes on as steeply as the node is pressed into the plane.
/// @param depth of the touching node in the plane [m]
/// @param s1, s2 distances of the next two nodes from it [m]; the first does not touch
/// @param gap1, gap2 theirs from the plane [m]
/// @returns distance from the touching node, in [0, s1] [m]
double beyond(double depth, double s1, double gap1, double s2, double gap2) {
  if (!(gap1 > 0.0)) return s1;
  const double crossing = s1 * depth / (depth + gap1);
  if (!(gap2 > gap1)) return crossing;
  const double ratio = std::sqrt(gap1 / gap2);  // (s1 - s0)/(s2 - s0)
  const double tangent = (s1 - ratio * s2) / (1.0 - ratio);
  return std::clamp(std::max(crossing, tangent), 0.0, s1);
}

/// The tread's nodes on the plane.
class Footprint {
 public:
  Footprint(const Tyre& tyre, const RigidPlane& plane)
      : grid_(tyre.tread_grid()), x_(tyre.surface().x), plane_(plane) {}

  int node(int i, int j) const { return grid_.node(i, j); }
  bool touches(int i, int j) const { return plane_.pressure()[node(i, j)] > 0.0; }
  Vector2 at(int i, int j) const { return x_.col(node(i, j)).head<2>(); }

  /// Distance from a touching node to the outline [m].
  /// @param along, across +1, -1 or 0: the way to the next node
  double end(int i, int j, int along, int across) const {
    const auto exists = [&](int k) { return k >= 0 && k < grid_.lines(); };
    if (!exists(j + across)) return 0.0;
    const bool two = exists(j + 2 * across);
    const Vector3 a = x_.col(node(i, j));
    const Vector3 b = x_.col(node(i + along, j + across));
    const Vector3 c = two ? Vector3(x_.col(node(i + 2 * along, j + 2 * across))) : b;
    const double floor = plane_.parameters().height;
    const double s1 = (b - a).norm();
    return beyond(std::max(0.0, floor - a.z()), s1, b.z() - floor, s1 + (c - b).norm(),
                  c.z() - floor);
  }

 private:
  const TreadGrid& grid_;
  const Matrix3X& x_;
  const RigidPlane& plane_;
};

/// One line of nodes around the tread that touches.
struct Line {
  int j = 0;
  int first = 0;         ///< touching node; may be negative, see TreadGrid::node()
  int last = 0;          ///< touching node
  double front = 0.0;    ///< [m] x of the outline
  double rear = 0.0;     ///< [m] x of the outline
  double lateral = 0.0;  ///< [m] y

  double length() const { return front - rear; }
};

std::optional<Line> touching_line(const Tyre& tyre, const Footprint& footprint, int j) {
  const Matrix3X& x = tyre.surface().x;
  const int n = tyre.tread_grid().around;
  int lowest = 0;
  for (int i = 0; i < n; ++i)
    if (x(2, footprint.node(i, j)) < x(2, footprint.node(lowest, j))) lowest = i;
  std::optional<Line> line;
  // the footprint is shorter than half the tyre
  for (int i = lowest - n / 4; i <= lowest + n / 4; ++i) {
    if (!footprint.touches(i, j)) continue;
    if (!line) line = Line{j, i};
    line->last = i;
  }
  if (!line) return line;
  line->front = footprint.at(line->last, j).x() + footprint.end(line->last, j, 1, 0);
  line->rear = footprint.at(line->first, j).x() - footprint.end(line->first, j, -1, 0);
  line->lateral = footprint.at(lowest, j).y();
  return line;
}

/// Area of the outline beyond the outermost line.
struct Side {
  double area = 0.0;   ///< [m^2]
  double width = 0.0;  ///< [m]
};

/// @param across +1 or -1: the side
Side beside(const Footprint& footprint, const Line& line, int across) {
  Side side;
  double x = line.rear;
  double width = 0.0;
  const auto go_to = [&](double next_x, double next_width) {
    side.area += 0.5 * (width + next_width) * (next_x - x);
    side.width = std::max(side.width, next_width);
    x = next_x;
    width = next_width;
  };
  for (int i = line.first; i <= line.last; ++i)
    if (footprint.touches(i, line.j))
      go_to(footprint.at(i, line.j).x(), footprint.end(i, line.j, 0, across));
  go_to(line.front, 0.0);
  return side;
}

// cosine of 45 degrees: walls of voids and flanks of the tread stand steeper on the plane
constexpr double lying = 0.70710678118654752;

/// Area of every node on the plane [m^2]: a third of each triangle around it that lies there.
VectorX lying_areas(const Surface& surface) {
  VectorX areas = VectorX::Zero(surface.x.cols());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Vector3 whole = surface.area_vector(t);
    if (-whole.z() <= lying * whole.norm()) continue;
    for (int k = 0; k < 3; ++k) areas[surface.triangles[t][k]] += whole.norm() / 3.0;
  }
  return areas;
}

}  // namespace

PrintStress print_stress(const Surface& surface, const RigidPlane& plane) {
  PrintStress print{plane.pressure(), lying_areas(surface)};
  for (Eigen::Index n = 0; n < print.area.size(); ++n) {
    if (!(print.pressure[n] > 0.0)) print.area[n] = 0.0;
    if (print.area[n] > 0.0) print.pressure[n] *= plane.area()[n] / print.area[n];
  }
  return print;
}

ContactPatch contact_patch(const Tyre& tyre, const RigidPlane& plane) {
  const TreadGrid& grid = tyre.tread_grid();
  const double copies = grid.copies();
  const Footprint footprint(tyre, plane);
  const PrintStress print = print_stress(tyre.surface(), plane);
  ContactPatch patch;
  std::vector<Line> lines;
  int inside = 0;
  int lifted = 0;
  for (int j = 0; j < grid.lines(); ++j) {
    const std::optional<Line> line = touching_line(tyre, footprint, j);
    if (!line) continue;
    lines.push_back(*line);
    patch.length = std::max(patch.length, line->length());
    for (int i = line->first; i <= line->last; ++i) {
      ++inside;
      lifted += !footprint.touches(i, j);
      patch.largest_pressure =
          std::max(patch.largest_pressure, print.pressure[footprint.node(i, j)]);
    }
  }
  patch.nodal_area = copies * print.area.sum();
  patch.force = copies * plane.total_force().z();
  if (lines.empty()) return patch;

  const Line &inner = lines.front(), &outer = lines.back();
  for (std::size_t k = 0; k + 1 < lines.size(); ++k)
    patch.perimeter_area += 0.5 * (lines[k].length() + lines[k + 1].length()) *
                            (lines[k + 1].lateral - lines[k].lateral);
  const Side left = beside(footprint, outer, 1);
  // a half model's outline goes on to the mid-plane
  const Side right = grid.half ? Side{inner.length() * inner.lateral, inner.lateral}
                               : beside(footprint, inner, -1);
  patch.perimeter_area = copies * (patch.perimeter_area + left.area + right.area);
  patch.width = copies * (outer.lateral - inner.lateral + left.width + right.width);
  if (patch.perimeter_area > 0.0) patch.mean_pressure = patch.force / patch.perimeter_area;
  patch.lifted_share = static_cast<double>(lifted) / inside;
  return patch;
}

}  // namespace furrow
