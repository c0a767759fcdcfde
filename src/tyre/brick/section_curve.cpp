// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/brick/section_curve.h"

#include <algorithm>

#include <Eigen/LU>

namespace furrow {

namespace {

constexpr int samples_between_points = 40;

}  // namespace

SectionCurve::SectionCurve(const std::vector<double>& axial, const std::vector<double>& radius) {
  const auto n = static_cast<Eigen::Index>(axial.size());
  points_.resize(2, n);
  for (Eigen::Index i = 0; i < n; ++i)
    points_.col(i) << axial[static_cast<std::size_t>(i)], radius[static_cast<std::size_t>(i)];
  t_.push_back(0.0);
  for (Eigen::Index i = 1; i < n; ++i)
    t_.push_back(t_.back() + (points_.col(i) - points_.col(i - 1)).norm());

  // second derivatives m at the points: the spline's first is continuous, (1, 0) at the beginning
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(n, 2);
  const auto step = [&](Eigen::Index i) {
    return t_[static_cast<std::size_t>(i) + 1] - t_[static_cast<std::size_t>(i)];
  };
  const auto slope = [&](Eigen::Index i) -> Vector2 {
    return (points_.col(i + 1) - points_.col(i)) / step(i);
  };
  system(0, 0) = step(0) / 3.0;
  system(0, 1) = step(0) / 6.0;
  right.row(0) = (slope(0) - Vector2(1.0, 0.0)).transpose();
  for (Eigen::Index i = 1; i + 1 < n; ++i) {
    system(i, i - 1) = step(i - 1) / 6.0;
    system(i, i) = (step(i - 1) + step(i)) / 3.0;
    system(i, i + 1) = step(i) / 6.0;
    right.row(i) = (slope(i) - slope(i - 1)).transpose();
  }
  system(n - 1, n - 1) = 1.0;
  second_ = system.partialPivLu().solve(right).transpose();

  Vector2 last = points_.col(0);
  sample_.push_back(0.0);
  arc_.push_back(0.0);
  for (std::size_t i = 0; i + 1 < t_.size(); ++i)
    for (int k = 1; k <= samples_between_points; ++k) {
      const double t = t_[i] + (t_[i + 1] - t_[i]) * k / samples_between_points;
      const Vector2 at = value(t, nullptr);
      sample_.push_back(t);
      arc_.push_back(arc_.back() + (at - last).norm());
      last = at;
    }
}

Vector2 SectionCurve::value(double t, Vector2* derivative) const {
  const auto next = std::upper_bound(t_.begin() + 1, t_.end() - 1, t);
  const auto i = static_cast<Eigen::Index>(next - t_.begin()) - 1;
  const double h = *next - *(next - 1);
  const double b = (t - *(next - 1)) / h;
  const double a = 1.0 - b;
  const Vector2 m0 = second_.col(i);
  const Vector2 m1 = second_.col(i + 1);
  if (derivative)
    *derivative = (points_.col(i + 1) - points_.col(i)) / h +
                  h / 6.0 * ((3.0 * b * b - 1.0) * m1 - (3.0 * a * a - 1.0) * m0);
  return a * points_.col(i) + b * points_.col(i + 1) +
         h * h / 6.0 * ((a * a * a - a) * m0 + (b * b * b - b) * m1);
}

double SectionCurve::parameter(double s) const {
  const auto next = std::upper_bound(arc_.begin() + 1, arc_.end() - 1, s);
  const auto i = static_cast<std::size_t>(next - arc_.begin());
  const double share = (s - arc_[i - 1]) / (arc_[i] - arc_[i - 1]);
  return sample_[i - 1] + share * (sample_[i] - sample_[i - 1]);
}

Vector2 SectionCurve::point(double s) const { return value(parameter(s), nullptr); }

Vector2 SectionCurve::normal(double s) const {
  Vector2 along;
  value(parameter(s), &along);
  return Vector2(-along[1], along[0]).normalized();
}

}  // namespace furrow
