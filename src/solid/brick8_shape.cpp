// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/solid/brick8_shape.h"

#include <cmath>

#include "furrow/core/error.h"

namespace furrow {

namespace {

// Parameter coordinates of the nodes
constexpr double xi[8] = {-1, 1, 1, -1, -1, 1, 1, -1};
constexpr double eta[8] = {-1, -1, 1, 1, -1, -1, 1, 1};
constexpr double zeta[8] = {-1, -1, -1, -1, 1, 1, 1, 1};
// Volume at a Gauss point over its mean below which it counts as none
constexpr double minimum_share = 1e-6;

/// Values of the shape functions at a point, and derivatives by the parameter coordinates.
struct Trilinear {
  Matrix38 derivative;
  Eigen::Matrix<double, 8, 1> value;

  Trilinear(double s, double t, double u) {
    for (int n = 0; n < 8; ++n) {
      const double a = 1.0 + xi[n] * s;
      const double b = 1.0 + eta[n] * t;
      const double c = 1.0 + zeta[n] * u;
      value[n] = a * b * c / 8.0;
      derivative.col(n) << xi[n] * b * c / 8.0, eta[n] * a * c / 8.0, zeta[n] * a * b / 8.0;
    }
  }
};

}  // namespace

Matrix38 in_own_axes(const Matrix38& nodes) {
  Vector3 a = Vector3::Zero();
  Vector3 b = Vector3::Zero();
  for (int n = 0; n < 8; ++n) {
    a += xi[n] * nodes.col(n);
    b += eta[n] * nodes.col(n);
  }
  Matrix3 axes;
  axes.col(0) = a.normalized();
  axes.col(2) = a.cross(b).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  const Vector3 mean = nodes.rowwise().mean();
  return axes.transpose() * (nodes.colwise() - mean);
}

Brick8Shape::Brick8Shape(const Matrix38& nodes) : mean_gradient(Matrix38::Zero()) {
  share.fill(0.0);
  const double gauss = 1.0 / std::sqrt(3.0);
  for (std::size_t q = 0; q < 8; ++q) {
    const Trilinear shape(gauss * xi[q], gauss * eta[q], gauss * zeta[q]);
    const Matrix3 jacobian = nodes * shape.derivative.transpose();
    weight[q] = jacobian.determinant();
    gradient[q] = jacobian.inverse().transpose() * shape.derivative;
    volume += weight[q];
    mean_gradient += weight[q] * gradient[q];
    for (std::size_t n = 0; n < 8; ++n)
      share[n] += weight[q] * shape.value[static_cast<Eigen::Index>(n)];
  }
  for (const double w : weight)
    if (!(w > minimum_share * std::abs(volume) / 8.0))
      throw StateError("is turned inside out, or has no volume");
  mean_gradient /= volume;
}

Matrix24 deviatoric_stiffness(const Brick8Shape& shape, double shear) {
  Matrix24 K = Matrix24::Zero();
  for (std::size_t q = 0; q < 8; ++q)
    for (int a = 0; a < 8; ++a)
      for (int b = 0; b < 8; ++b) {
        const Vector3 ga = shape.gradient[q].col(a);
        const Vector3 gb = shape.gradient[q].col(b);
        K.block<3, 3>(3 * a, 3 * b) += shape.weight[q] * shear *
                                       (ga.dot(gb) * Matrix3::Identity() + gb * ga.transpose() -
                                        2.0 / 3.0 * ga * gb.transpose());
      }
  return K;
}

Matrix24 volumetric_stiffness(const Brick8Shape& shape, double bulk) {
  const Eigen::Map<const Eigen::Matrix<double, 24, 1>> b(shape.mean_gradient.data());
  return bulk * shape.volume * b * b.transpose();
}

}  // namespace furrow
