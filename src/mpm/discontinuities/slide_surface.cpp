// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/discontinuities/slide_surface.h"

#include <algorithm>
#include <cmath>

namespace furrow {

namespace {

double distance(const SlidePlane& plane, const Vector3& x) {
  return plane.normal.dot(x - plane.point);
}
double distance(const SlideCylinder& cylinder, const Vector3& x) {
  return std::hypot(x[0] - cylinder.x, x[1] - cylinder.y) - cylinder.radius;
}
double beyond_ends(const SlideBox& box, const Vector3& x) {
  return std::abs(x[0] - box.x) - 0.5 * box.length;
}
double beyond_sides(const SlideBox& box, const Vector3& x) {
  return std::abs(x[1] - box.y) - 0.5 * box.width;
}
double distance(const SlideBox& box, const Vector3& x) {
  return std::max(beyond_ends(box, x), beyond_sides(box, x));
}

Vector3 normal(const SlidePlane& plane, const Vector3&) { return plane.normal; }
Vector3 normal(const SlideCylinder& cylinder, const Vector3& x) {
  const Vector3 radial(x[0] - cylinder.x, x[1] - cylinder.y, 0.0);
  const double length = radial.norm();
  return length > 0.0 ? Vector3(radial / length) : Vector3::UnitX();
}
Vector3 normal(const SlideBox& box, const Vector3& x) {
  if (beyond_ends(box, x) >= beyond_sides(box, x))
    return {std::copysign(1.0, x[0] - box.x), 0.0, 0.0};
  return {0.0, std::copysign(1.0, x[1] - box.y), 0.0};
}

}  // namespace

std::size_t SlideSurface::side(const Vector3& x) const {
  return std::visit([&](const auto& of) { return distance(of, x) < 0.0 ? 0u : 1u; }, shape);
}

Vector3 SlideSurface::normal(const Vector3& x) const {
  return std::visit([&](const auto& of) { return furrow::normal(of, x); }, shape);
}

}  // namespace furrow
