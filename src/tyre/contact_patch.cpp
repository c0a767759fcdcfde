// SPDX-License-Identifier: GPL-2.0-or-later
#include "tyre/contact_patch.h"

#include <algorithm>
#include <cmath>

namespace furrow {

namespace {

/// Outline end beyond the last touching node, from it, in [0, distance to the first free node].
double beyond(double s1, double gap1, double s2, double gap2) {
  if (!(gap1 > 0.0)) return s1;
  if (!(gap2 > gap1)) return 0.0;
  const double ratio = std::sqrt(gap1 / gap2);  // (s1 - s0)/(s2 - s0)
  return std::clamp((s1 - ratio * s2) / (1.0 - ratio), 0.0, s1);
}

}  // namespace

ContactPatch contact_patch(const DarnellTyre& tyre, const RigidPlane& plane) {
  const Matrix3X& x = tyre.tread().x;
  const int n = tyre.settings().around, rows = tyre.rows();
  const double floor = plane.parameters().height, share = tyre.settings().half ? 2.0 : 1.0;
  ContactPatch patch;
  std::vector<double> lengths(static_cast<std::size_t>(rows + 1), 0.0), lateral(lengths);
  int inside = 0, lifted = 0;
  for (int j = 0; j <= rows; ++j) {
    const auto touches = [&](int i) { return plane.pressure()[tyre.tread_node(i, j)] > 0.0; };
    // node numbers around; the patch is narrower than half the tyre
    int lowest = 0, first = 0, last = 0;
    for (int i = 0; i < n; ++i)
      if (x(2, tyre.tread_node(i, j)) < x(2, tyre.tread_node(lowest, j))) lowest = i;
    bool any = false;
    for (int i = lowest - n / 4; i <= lowest + n / 4; ++i)
      if (touches(i)) {
        if (!any) first = i;
        last = i;
        any = true;
      }
    lateral[static_cast<std::size_t>(j)] = x(1, tyre.tread_node(lowest, j));
    if (!any) continue;
    const auto end = [&](int touching, int step) {
      const Vector3 a = x.col(tyre.tread_node(touching, j)),
                    b = x.col(tyre.tread_node(touching + step, j)),
                    c = x.col(tyre.tread_node(touching + 2 * step, j));
      const double s1 = (b - a).norm(), s2 = s1 + (c - b).norm();
      return beyond(s1, b.z() - floor, s2, c.z() - floor);
    };
    double length = end(last, 1) + end(first, -1);
    for (int i = first; i < last; ++i)
      length += (x.col(tyre.tread_node(i + 1, j)) - x.col(tyre.tread_node(i, j))).head<2>().norm();
    for (int i = first; i <= last; ++i) {
      const Eigen::Index node = tyre.tread_node(i, j);
      ++inside;
      lifted += !touches(i);
      patch.largest_pressure = std::max(patch.largest_pressure, plane.pressure()[node]);
      if (touches(i)) patch.nodal_area += share * plane.area()[node];
    }
    lengths[static_cast<std::size_t>(j)] = length;
    patch.length = std::max(patch.length, length);
  }
  for (std::size_t j = 0; j < static_cast<std::size_t>(rows); ++j) {
    const double across = lateral[j + 1] - lateral[j];
    patch.perimeter_area += share * 0.5 * (lengths[j] + lengths[j + 1]) * across;
    if (lengths[j] > 0.0 && lengths[j + 1] > 0.0) patch.width += share * across;
  }
  patch.force = share * plane.total_force().z();
  if (patch.perimeter_area > 0.0) patch.mean_pressure = patch.force / patch.perimeter_area;
  if (inside > 0) patch.lifted_share = static_cast<double>(lifted) / inside;
  return patch;
}

}  // namespace furrow
