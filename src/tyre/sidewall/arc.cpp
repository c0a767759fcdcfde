// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/sidewall/arc.h"

#include <algorithm>
#include <cmath>

namespace furrow {

namespace {

constexpr double straight = 1e-6;  // [rad] half angle below which an arc is its chord

}  // namespace

double arc_half_angle(double share) {
  if (share >= 1.0) return 0.0;
  // Newton's method from the first terms of the series in 1 - share
  double alpha = std::min(3.0, std::sqrt(6.0 * (1.0 - share) * (1.0 + 0.15 * (1.0 - share))));
  for (int i = 0; i < 8; ++i) {
    const double s = std::sin(alpha);
    const double change = (s - share * alpha) / (share - std::cos(alpha));
    alpha = std::clamp(alpha + change, 0.25 * alpha, 0.5 * (alpha + pi));
    if (std::abs(change) < 1e-12) break;
  }
  return alpha;
}

Arc::Arc(const Vector3& from, const Vector3& to, double length, const Vector3& outwards)
    : from_(from) {
  const Vector3 span = to - from;
  chord_ = span.norm();
  alpha_ = arc_half_angle(chord_ / length);
  along_ = span / chord_;
  outwards_ = (outwards - outwards.dot(along_) * along_).normalized();
  radius_ = alpha_ > straight ? 0.5 * chord_ / std::sin(alpha_) : 0.0;
}

Vector3 Arc::point(double share) const {
  const double beta = alpha_ * (2.0 * share - 1.0);  // from -alpha at the first end
  const double forward = radius_ > 0.0 ? radius_ * std::sin(beta) : chord_ * (share - 0.5);
  const double bulge = radius_ > 0.0 ? radius_ * (std::cos(beta) - std::cos(alpha_)) : 0.0;
  return from_ + (0.5 * chord_ + forward) * along_ + bulge * outwards_;
}

}  // namespace furrow
