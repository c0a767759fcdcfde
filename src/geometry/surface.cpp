// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/geometry/surface.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/geometry/closed_surface.h"
#include "furrow/core/error.h"

namespace furrow {

void Surface::resize(std::size_t nodes) {
  x.setZero(3, static_cast<Eigen::Index>(nodes));
  v.setZero(3, static_cast<Eigen::Index>(nodes));
  f.setZero(3, static_cast<Eigen::Index>(nodes));
}

Vector3 Surface::total_force() const {
  // Eigen sums the rows of an aligned result in another order than those of an unaligned one: made
  // in a place of known alignment the sum is the same to the last bit whoever calls
  struct {
    alignas(16) Vector3 force;
  } sum;
  sum.force = f.rowwise().sum();
  return sum.force;
}

Vector3 Surface::total_moment(const Vector3& about) const {
  Vector3 moment = Vector3::Zero();
  for (Eigen::Index node = 0; node < x.cols(); ++node) {
    if (f(0, node) == 0.0 && f(1, node) == 0.0 && f(2, node) == 0.0) continue;  // off the ground
    moment += (x.col(node) - about).cross(f.col(node));
  }
  return moment;
}

Vector3 Surface::area_vector(std::size_t triangle) const {
  const Vector3i& nodes = triangles[triangle];
  const Vector3 a = x.col(nodes[0]);
  const Vector3 ab = x.col(nodes[1]) - a;
  const Vector3 ac = x.col(nodes[2]) - a;
  return 0.5 * ab.cross(ac);
}

VectorX Surface::node_areas() const {
  VectorX areas = VectorX::Zero(x.cols());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) areas[triangles[t][k]] += area_vector(t).norm() / 3.0;
  return areas;
}

double Surface::total_area() const {
  double area = 0.0;
  for (std::size_t triangle = 0; triangle < triangles.size(); ++triangle)
    area += area_vector(triangle).norm();
  return area;
}

double Surface::minimum_angle() const {
  double angle = pi / 3.0;  // no triangle has a larger smallest corner
  for (const Vector3i& nodes : triangles)
    for (int corner = 0; corner < 3; ++corner) {
      const Vector3 here = x.col(nodes[corner]);
      const Vector3 a = x.col(nodes[(corner + 1) % 3]) - here,
                    b = x.col(nodes[(corner + 2) % 3]) - here;
      angle = std::min(angle, std::atan2(a.cross(b).norm(), a.dot(b)));
    }
  return angle;
}

// Divergence theorem, V = (1/3) sum of x . A; taken from the first node, so that a surface far from
// the origin loses no digits.
double Surface::enclosed_volume() const {
  if (triangles.empty()) return 0.0;
  const Vector3 origin = x.col(0);
  double volume = 0.0;
  for (std::size_t triangle = 0; triangle < triangles.size(); ++triangle)
    volume += (x.col(triangles[triangle][0]) - origin).dot(area_vector(triangle)) / 3.0;
  return volume;
}

std::pair<Vector3, Vector3> Surface::bounds() const {
  if (x.cols() == 0) throw StateError("a surface without nodes has no bounds");
  return {x.rowwise().minCoeff(), x.rowwise().maxCoeff()};
}

bool Surface::is_closed() const { return closedness_problem(*this).empty(); }

void Surface::check_finite(const std::string& body) const {
  if (x.allFinite() && v.allFinite()) return;
  for (Eigen::Index node = 0; node < x.cols(); ++node) {
    const bool position = !x.col(node).allFinite();
    if (!position && v.col(node).allFinite()) continue;
    const Vector3 value = position ? x.col(node) : v.col(node);
    throw StateError(fmt::format("body '{}': the {} of node {} is not finite ({} {} {})", body,
                                 position ? "position" : "velocity", node, value.x(), value.y(),
                                 value.z()));
  }
}

}  // namespace furrow
