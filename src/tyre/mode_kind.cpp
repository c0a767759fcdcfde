// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/mode_kind.h"

#include <cmath>

namespace furrow {

namespace {

/// Radial, circumferential and axial part of the shape at the nodes.
Matrix3X cylindrical(const Tyre& tyre, const Matrix3X& shape) {
  const Matrix3X& x = tyre.surface().x;
  const Vector3 axle = tyre.axle();
  Matrix3X parts(3, shape.cols());
  for (Eigen::Index n = 0; n < shape.cols(); ++n) {
    const Vector3 from_axle = x.col(n) - tyre.centre();
    const Vector3 outwards = (from_axle - from_axle.dot(axle) * axle).normalized();
    const Vector3 u = shape.col(n);
    parts.col(n) << u.dot(outwards), u.dot(axle.cross(outwards)), u.dot(axle);
  }
  return parts;
}

}  // namespace

ModeKind kind_of(const Tyre& tyre, const Matrix3X& shape) {
  const TreadGrid& grid = tyre.tread_grid();
  const Matrix3X parts = cylindrical(tyre, shape);
  const double total = parts.squaredNorm();
  ModeKind kind;
  kind.radial = parts.row(0).squaredNorm() / total;
  kind.circumferential = parts.row(1).squaredNorm() / total;
  kind.axial = parts.row(2).squaredNorm() / total;

  for (int n = 0; n <= grid.around / 2; ++n) {
    // Parseval: both signs of n, once for n = 0 and for the largest n
    const double signs = n == 0 || 2 * n == grid.around ? 1.0 : 2.0;
    double motion = 0.0;
    for (int j = 0; j < grid.lines(); ++j) {
      Vector3 cosine = Vector3::Zero(), sine = Vector3::Zero();
      for (int i = 0; i < grid.around; ++i) {
        const double angle = 2.0 * pi * n * i / grid.around;
        cosine += std::cos(angle) * parts.col(grid.node(i, j));
        sine += std::sin(angle) * parts.col(grid.node(i, j));
      }
      motion += signs * (cosine.squaredNorm() + sine.squaredNorm()) / grid.around;
    }
    if (motion / total > kind.wave_share) {
      kind.waves = n;
      kind.wave_share = motion / total;
    }
  }
  return kind;
}

}  // namespace furrow
