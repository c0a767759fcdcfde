// SPDX-License-Identifier: GPL-2.0-or-later
#include "tyre/contact_patch.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace furrow {

namespace {

/// Distance from the last touching node to the end of the outline, in [0, s1].
/// @param s1, s2 distances of the next two nodes, which do not touch [m]
/// @param gap1, gap2 theirs from the plane [m]
double beyond(double s1, double gap1, double s2, double gap2) {
  if (!(gap1 > 0.0)) return s1;
  if (!(gap2 > gap1)) return 0.0;
  const double ratio = std::sqrt(gap1 / gap2);  // (s1 - s0)/(s2 - s0)
  return std::clamp((s1 - ratio * s2) / (1.0 - ratio), 0.0, s1);
}

/// One line of nodes around the tread.
class Line {
 public:
  Line(const Tyre& tyre, const RigidPlane& plane, int j)
      : grid_(tyre.tread_grid()), x_(tyre.surface().x), plane_(plane), j_(j) {
    const int n = grid_.around;
    for (int i = 0; i < n; ++i)
      if (x_(2, node(i)) < x_(2, node(lowest_))) lowest_ = i;
    // the footprint is shorter than half the tyre
    for (int i = lowest_ - n / 4; i <= lowest_ + n / 4; ++i)
      if (touches(i)) {
        if (!touching_) first_ = i;
        last_ = i;
        touching_ = true;
      }
  }

  bool touching() const { return touching_; }
  int first() const { return first_; }  ///< touching node; may be negative, see TreadGrid::node()
  int last() const { return last_; }    ///< touching node
  int node(int i) const { return grid_.node(i, j_); }
  bool touches(int i) const { return plane_.pressure()[node(i)] > 0.0; }
  double lateral() const { return x_(1, node(lowest_)); }  ///< [m] y

  double length() const {
    double length = end(last_, 1) + end(first_, -1);
    for (int i = first_; i < last_; ++i)
      length += (x_.col(node(i + 1)) - x_.col(node(i))).head<2>().norm();
    return length;
  }

 private:
  /// [m] from the outermost touching node to the end of the outline.
  /// @param step +1 or -1: away from the footprint
  double end(int touching, int step) const {
    const double floor = plane_.parameters().height;
    const Vector3 a = x_.col(node(touching));
    const Vector3 b = x_.col(node(touching + step));
    const Vector3 c = x_.col(node(touching + 2 * step));
    const double s1 = (b - a).norm();
    const double s2 = s1 + (c - b).norm();
    return beyond(s1, b.z() - floor, s2, c.z() - floor);
  }

  const TreadGrid& grid_;
  const Matrix3X& x_;
  const RigidPlane& plane_;
  int j_;
  int lowest_ = 0;
  int first_ = 0;
  int last_ = 0;
  bool touching_ = false;
};

// cosine of 45 degrees: walls of voids and flanks of the tread stand steeper on the plane
constexpr double lying = 0.70710678118654752;

/// [m^2] of the triangles that lie on the plane, a third for each of their touching nodes.
double area_of_touching_nodes(const Surface& surface, const RigidPlane& plane) {
  double area = 0.0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Vector3i& corners = surface.triangles[t];
    int touching = 0;
    for (int k = 0; k < 3; ++k) touching += plane.pressure()[corners[k]] > 0.0;
    if (touching == 0) continue;
    const Vector3 whole = surface.area_vector(t);
    if (-whole.z() > lying * whole.norm()) area += whole.norm() * touching / 3.0;
  }
  return area;
}

}  // namespace

ContactPatch contact_patch(const Tyre& tyre, const RigidPlane& plane) {
  const TreadGrid& grid = tyre.tread_grid();
  const double copies = grid.copies();
  ContactPatch patch;
  std::vector<double> lengths;  // [m] of the lines
  std::vector<double> lateral;  // [m] where they are
  int inside = 0;
  int lifted = 0;
  for (int j = 0; j < grid.lines(); ++j) {
    const Line line(tyre, plane, j);
    lateral.push_back(line.lateral());
    lengths.push_back(line.touching() ? line.length() : 0.0);
    patch.length = std::max(patch.length, lengths.back());
    for (int i = line.first(); line.touching() && i <= line.last(); ++i) {
      const int node = line.node(i);
      ++inside;
      lifted += !line.touches(i);
      patch.largest_pressure = std::max(patch.largest_pressure, plane.pressure()[node]);
    }
  }
  for (std::size_t j = 0; j + 1 < lengths.size(); ++j) {
    const double across = lateral[j + 1] - lateral[j];
    patch.perimeter_area += copies * 0.5 * (lengths[j] + lengths[j + 1]) * across;
    if (lengths[j] > 0.0 && lengths[j + 1] > 0.0) patch.width += copies * across;
  }
  patch.nodal_area = copies * area_of_touching_nodes(tyre.surface(), plane);
  patch.force = copies * plane.total_force().z();
  if (patch.perimeter_area > 0.0) patch.mean_pressure = patch.force / patch.perimeter_area;
  if (inside > 0) patch.lifted_share = static_cast<double>(lifted) / inside;
  return patch;
}

}  // namespace furrow
