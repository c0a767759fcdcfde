// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/shell/shell4_stiffness.h"

#include <array>
#include <cmath>

#include <Eigen/LU>

#include "furrow/core/error.h"

namespace furrow {

namespace {

using Row24 = Eigen::Matrix<double, 1, 24>;
using Rows2 = Eigen::Matrix<double, 2, 24>;
using Rows3 = Eigen::Matrix<double, 3, 24>;

constexpr std::array<double, 4> node_xi = {-1, 1, 1, -1}, node_eta = {-1, -1, 1, 1};

/// Everything of the reference at one point of the parameter square.
struct Point {
  Eigen::Vector4d N;
  Eigen::Matrix<double, 4, 2> dN;  // by xi, eta
  Eigen::Matrix<double, 3, 2> a;   // covariant base vectors [m]
  Vector3 n;                       // director
  Eigen::Matrix<double, 3, 2> dn;  // its derivatives

  Point(const Shell4Shape& shape, double xi, double eta) {
    for (int k = 0; k < 4; ++k) {
      N[k] = 0.25 * (1.0 + node_xi[k] * xi) * (1.0 + node_eta[k] * eta);
      dN(k, 0) = 0.25 * node_xi[k] * (1.0 + node_eta[k] * eta);
      dN(k, 1) = 0.25 * node_eta[k] * (1.0 + node_xi[k] * xi);
    }
    a = shape.x * dN;
    n = shape.director * N;
    dn = shape.director * dN;
  }
};

/// Local orthonormal axes, and the Jacobian of parameter lines in them.
struct Axes {
  Vector3 t1, t2;
  double area;              // |a_1 x a_2|
  Eigen::Matrix2d inverse;  // (i, alpha): t_i . a^alpha

  Axes(const Point& point, const Vector3& fibre) {
    const Vector3 cross = point.a.col(0).cross(point.a.col(1));
    area = cross.norm();
    const Vector3 t3 = cross / area;
    t1 = (fibre - fibre.dot(t3) * t3).normalized();
    t2 = t3.cross(t1);
    Eigen::Matrix2d jacobian;  // (alpha, i): a_alpha . t_i
    jacobian << point.a.col(0).dot(t1), point.a.col(0).dot(t2), point.a.col(1).dot(t1),
        point.a.col(1).dot(t2);
    inverse = jacobian.inverse();  // (i, alpha)
  }

  /// From covariant (11, 22, 2 x 12) to the axes' (11, 22, 2 x 12).
  Matrix3 strain_map() const {
    const double a = inverse(0, 0), b = inverse(0, 1), c = inverse(1, 0), d = inverse(1, 1);
    Matrix3 map;
    map << a * a, b * b, a * b, c * c, d * d, c * d, 2 * a * c, 2 * b * d, a * d + b * c;
    return map;
  }
};

/// a . displacement derivative
void add_displacement(Eigen::Ref<Row24> row, const Vector3& a, const Eigen::Vector4d& weight) {
  for (int k = 0; k < 4; ++k) row.segment<3>(6 * k) += weight[k] * a.transpose();
}

/// a . (rotation x director), i.e. rotation . (director x a)
void add_director(Eigen::Ref<Row24> row, const Shell4Shape& shape, const Vector3& a,
                  const Eigen::Vector4d& weight) {
  for (int k = 0; k < 4; ++k)
    row.segment<3>(6 * k + 3) += weight[k] * Vector3(shape.director.col(k)).cross(a).transpose();
}

Rows3 membrane_rows(const Point& p) {
  Rows3 rows = Rows3::Zero();
  Row24 row = Row24::Zero();
  for (int alpha = 0; alpha < 2; ++alpha) {
    row.setZero();
    add_displacement(row, p.a.col(alpha), p.dN.col(alpha));
    rows.row(alpha) = row;
  }
  row.setZero();
  add_displacement(row, p.a.col(0), p.dN.col(1));
  add_displacement(row, p.a.col(1), p.dN.col(0));
  rows.row(2) = row;
  return rows;
}

Rows3 bending_rows(const Shell4Shape& shape, const Point& p) {
  Rows3 rows = Rows3::Zero();
  Row24 row = Row24::Zero();
  for (int alpha = 0; alpha < 2; ++alpha) {
    row.setZero();
    add_director(row, shape, p.a.col(alpha), p.dN.col(alpha));
    add_displacement(row, p.dn.col(alpha), p.dN.col(alpha));
    rows.row(alpha) = row;
  }
  row.setZero();
  for (int alpha = 0; alpha < 2; ++alpha) {
    add_director(row, shape, p.a.col(alpha), p.dN.col(1 - alpha));
    add_displacement(row, p.dn.col(alpha), p.dN.col(1 - alpha));
  }
  rows.row(2) = row;
  return rows;
}

/// Covariant transverse shear along one parameter line.
Row24 shear_row(const Shell4Shape& shape, double xi, double eta, int alpha) {
  const Point p(shape, xi, eta);
  Row24 row = Row24::Zero();
  add_director(row, shape, p.a.col(alpha), p.N);
  add_displacement(row, p.n, p.dN.col(alpha));
  return row;
}

/// Turn of the element about its axis 3 in small displacements: the linear part of Shell4's frame.
Row24 turn_row(const Shell4Shape& shape) {
  const Vector3 a = first_median(shape.x), b = second_median(shape.x);
  Eigen::Matrix2d medians;
  medians << a[0], b[0], a[1], b[1];
  const Eigen::Matrix2d inverse = medians.inverse();
  const double s[4] = {-0.5, 0.5, 0.5, -0.5}, t[4] = {-0.5, -0.5, 0.5, 0.5};
  Row24 row = Row24::Zero();
  for (int k = 0; k < 4; ++k) {
    row[6 * k + 1] = 0.5 * (inverse(0, 0) * s[k] + inverse(1, 0) * t[k]);
    row[6 * k] = -0.5 * (inverse(0, 1) * s[k] + inverse(1, 1) * t[k]);
  }
  return row;
}

}  // namespace

Matrix24 shell4_stiffness(const Shell4Shape& shape, const ShellSection& section) {
  const Row24 shear1[2] = {shear_row(shape, 0, -1, 0), shear_row(shape, 0, 1, 0)};
  const Row24 shear2[2] = {shear_row(shape, -1, 0, 1), shear_row(shape, 1, 0, 1)};
  const Point middle(shape, 0, 0);
  const Axes middle_axes(middle, shape.fibre);
  const Matrix3 middle_map = middle_axes.strain_map();

  Matrix24 K = Matrix24::Zero();
  Eigen::Matrix<double, 4, 24> coupling = Eigen::Matrix<double, 4, 24>::Zero();
  Eigen::Matrix4d enhanced = Eigen::Matrix4d::Zero();
  const double g = 1.0 / std::sqrt(3.0);
  for (int k = 0; k < 4; ++k) {
    const double xi = g * node_xi[k], eta = g * node_eta[k];
    const Point p(shape, xi, eta);
    const Axes axes(p, shape.fibre);
    if (!(axes.area > 0.0) || !(p.a.col(0).cross(p.a.col(1)).z() > 0.0))
      throw StateError("shell: an element is folded; its nodes must go round it in one sense");
    const Matrix3 map = axes.strain_map();
    const Rows3 membrane = map * membrane_rows(p), bending = map * bending_rows(shape, p);
    Rows2 shear;
    shear.row(0) = 0.5 * (1.0 - eta) * shear1[0] + 0.5 * (1.0 + eta) * shear1[1];
    shear.row(1) = 0.5 * (1.0 - xi) * shear2[0] + 0.5 * (1.0 + xi) * shear2[1];
    shear = (axes.inverse * shear).eval();
    Eigen::Matrix<double, 3, 4> modes = Eigen::Matrix<double, 3, 4>::Zero();
    modes(0, 0) = xi;
    modes(1, 1) = eta;
    modes(2, 2) = xi;
    modes(2, 3) = eta;
    modes = (middle_axes.area / axes.area * middle_map * modes).eval();

    K += axes.area * (membrane.transpose() * section.membrane * membrane +
                      bending.transpose() * section.bending * bending +
                      shear.transpose() * section.shear * shear);
    coupling += axes.area * modes.transpose() * section.membrane * membrane;
    enhanced += axes.area * modes.transpose() * section.membrane * modes;
  }
  K -= coupling.transpose() * enhanced.inverse() * coupling;

  const double drilling = drilling_share * 0.5 * (section.bending(0, 0) + section.bending(1, 1));
  const Row24 turn = turn_row(shape);
  for (int k = 0; k < 4; ++k) {
    Row24 row = -turn;
    row[6 * k + 5] += 1.0;
    K += drilling * row.transpose() * row;
  }
  return 0.5 * (K + K.transpose());
}

}  // namespace furrow
