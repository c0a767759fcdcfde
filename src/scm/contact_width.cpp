// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/scm/contact_width.h"

#include <algorithm>

namespace furrow {

namespace {

double turn(const Vector2& a, const Vector2& b, const Vector2& c) {
  const Vector2 u = b - a, v = c - a;
  return u.x() * v.y() - u.y() * v.x();
}

}  // namespace

/// Monotone chain [Andrew1979].
double hull_perimeter(std::vector<Vector2>& points, std::vector<Vector2>& hull) {
  std::sort(points.begin(), points.end(), [](const Vector2& a, const Vector2& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  hull.clear();
  const auto add = [&](const Vector2& point, std::size_t kept) {
    while (hull.size() > kept && turn(hull[hull.size() - 2], hull.back(), point) <= 0.0)
      hull.pop_back();
    hull.push_back(point);
  };
  for (const Vector2& point : points) add(point, 1);
  const std::size_t lower = hull.size();
  for (std::size_t k = points.size() - 1; k-- > 0;) add(points[k], lower);
  double perimeter = 0.0;
  for (std::size_t k = 0; k + 1 < hull.size(); ++k) perimeter += (hull[k + 1] - hull[k]).norm();
  return perimeter;
}

}  // namespace furrow
