// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/shell/shell4_shape.h"

#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

constexpr double same_shape = 1e-9;  // of the element's size

/// An element's stress-free axes in space, columns.
Matrix3 stress_free_axes(const Matrix34& x) {
  const Vector3 a = first_median(x);
  const Vector3 normal = a.cross(second_median(x));
  if (!(normal.norm() > 1e-10 * a.squaredNorm())) throw StateError("has no area");
  Matrix3 axes;
  axes.col(0) = a.normalized();
  axes.col(2) = normal.normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

Matrix34 corners(const Matrix3X& x, const std::array<int, 4>& quad) {
  Matrix34 corner;
  for (int k = 0; k < 4; ++k) corner.col(k) = x.col(quad[static_cast<std::size_t>(k)]);
  return corner;
}

Vector3 corner_normal(const Matrix34& x, int k) {
  return (x.col((k + 1) % 4) - x.col(k)).cross(x.col((k + 3) % 4) - x.col(k)).normalized();
}

/// Unit normals of the elements around each node.
std::vector<std::vector<Vector3>> normals_at_nodes(const Matrix3X& x,
                                                   const std::vector<std::array<int, 4>>& quads) {
  std::vector<std::vector<Vector3>> normals(static_cast<std::size_t>(x.cols()));
  for (const std::array<int, 4>& quad : quads) {
    const Matrix34 corner = corners(x, quad);
    for (int k = 0; k < 4; ++k)
      normals[static_cast<std::size_t>(quad[static_cast<std::size_t>(k)])].push_back(
          corner_normal(corner, k));
  }
  return normals;
}

/// The section's axis 1 in the element's plane and axes, from a direction there in space.
Vector3 fibre_in_plane(const Matrix3& axes, const Vector3& direction) {
  const Vector3 local = axes.transpose() * direction;
  const double along = local.head<2>().norm();
  if (!(along > 1e-6 * local.norm())) throw StateError("has its fibre along its normal");
  Vector3 fibre;
  fibre << local.head<2>() / along, 0.0;
  return fibre;
}

}  // namespace

std::vector<Shell4Element> shell4_elements(const Matrix3X& x,
                                           const std::vector<std::array<int, 4>>& quads,
                                           const std::function<Vector3(const Vector3&)>& fibre,
                                           double largest_kink) {
  const double nearest = std::cos(largest_kink);
  const std::vector<std::vector<Vector3>> normals = normals_at_nodes(x, quads);
  std::vector<Shell4Element> elements(quads.size());
  for (std::size_t e = 0; e < quads.size(); ++e) {
    try {
      const Matrix34 corner = corners(x, quads[e]);
      const Vector3 centre = corner.rowwise().mean();
      Shell4Element& element = elements[e];
      element.nodes = quads[e];
      element.axes = stress_free_axes(corner);
      element.shape.x = element.axes.transpose() * (corner.colwise() - centre);
      element.shape.fibre = fibre_in_plane(element.axes, fibre(centre));
      for (int k = 0; k < 4; ++k) {
        const Vector3 own = corner_normal(corner, k);
        Vector3 sum = Vector3::Zero();
        for (const Vector3& normal :
             normals[static_cast<std::size_t>(quads[e][static_cast<std::size_t>(k)])])
          if (normal.dot(own) >= nearest) sum += normal;
        element.shape.director.col(k) = element.axes.transpose() * sum.normalized();
      }
    } catch (const StateError& error) {
      throw StateError(fmt::format("shell: element {} {}", e, error.what()));
    }
  }
  return elements;
}

bool alike(const Shell4Shape& a, const Shell4Shape& b) {
  const double size = b.x.cwiseAbs().maxCoeff();
  return (a.x - b.x).cwiseAbs().maxCoeff() < same_shape * size &&
         (a.director - b.director).cwiseAbs().maxCoeff() < same_shape &&
         (a.fibre - b.fibre).cwiseAbs().maxCoeff() < same_shape;
}

}  // namespace furrow
