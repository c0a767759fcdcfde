// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/geometry/weld.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace furrow {

namespace {

/// Nearest distance along one axis, over the periodic images.
double axis_distance(double a, double b, double period) {
  const double d = std::abs(a - b);
  return period > 0.0 ? std::abs(d - period * std::round(d / period)) : d;
}

}  // namespace

std::vector<int> weld_nodes(const Matrix3X& x, const Vector3& period, double tolerance) {
  const auto count = static_cast<std::size_t>(x.cols());
  // Sorts along an axis that is not periodic, so that only a few neighbours are compared. In a
  // fully periodic box every pair is compared, which is affordable once for thousands of nodes.
  int axis = 0;
  while (axis < 2 && period[axis] > 0.0) ++axis;
  const bool sorted = !(period[axis] > 0.0);
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  if (sorted)
    std::sort(order.begin(), order.end(), [&](int a, int b) { return x(axis, a) < x(axis, b); });

  std::vector<int> representative(count);
  std::iota(representative.begin(), representative.end(), 0);
  const auto root = [&](int node) {
    while (representative[static_cast<std::size_t>(node)] != node)
      node = representative[static_cast<std::size_t>(node)];
    return node;
  };
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j) {
      const int a = order[i], b = order[j];
      if (sorted && x(axis, b) - x(axis, a) > tolerance) break;
      if (axis_distance(x(0, a), x(0, b), period[0]) > tolerance ||
          axis_distance(x(1, a), x(1, b), period[1]) > tolerance ||
          axis_distance(x(2, a), x(2, b), period[2]) > tolerance)
        continue;
      const int ra = root(a), rb = root(b);
      representative[static_cast<std::size_t>(std::max(ra, rb))] = std::min(ra, rb);
    }
  for (std::size_t i = 0; i < count; ++i) representative[i] = root(static_cast<int>(i));
  return representative;
}

}  // namespace furrow
