// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/scm/rft_law.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace furrow {

namespace {

constexpr double upright = 1e-9;  // cosines that are round-off of zero

using Terms = std::array<double, 20>;
// Fit to runs of a continuum [Agarwal2023], in the order of the terms below
constexpr std::array<Terms, 3> fit = {{
    {0.00212,  -0.02320, -0.20890, -0.43083, -0.00259, 0.48872, -0.00415,
     0.07204,  -0.02750, -0.08772, 0.01992,  -0.45961, 0.40799, -0.10107,
     -0.06576, 0.05664,  -0.09269, 0.01892,  0.01033,  0.15120},
    {-0.06796, -0.10941, 0.04725, -0.06914, -0.05835, -0.65880, -0.11985,
     -0.25739, -0.26834, 0.02692, -0.00736, 0.63758,  0.08997,  0.21069,
     0.04748,  0.20406,  0.18589, 0.04934,  0.13527,  -0.33207},
    {-0.02634, -0.03436, 0.45256, 0.00835,  0.02553, -1.31290, -0.05532,
     0.06790,  -0.16404, 0.02287, 0.02927,  0.95406, -0.00131, -0.11028,
     0.01487,  -0.02730, 0.10911, -0.04097, 0.07881, -0.27519},
}};

Terms terms(double a, double b, double c) {
  return {1.0,       a,         b,         c,         a * a,     b * b,     c * c,
          a * b,     b * c,     c * a,     a * a * a, b * b * b, c * c * c, a * b * b,
          b * a * a, b * c * c, c * b * b, c * a * a, a * c * c, a * b * c};
}

}  // namespace

/// In vectors, the angles of [Agarwal2023] are not needed: with the normal m of the side of the
/// face that looks down, the fit is f1 m + f2 v - f3 e_z.
RftStress rft_stress(const Vector3& n, const Vector3& v, double friction) {
  RftStress stress;
  if (n.dot(v) < -upright) return stress;
  const Vector3 down = n.z() <= upright ? n : Vector3(-n);
  const Terms t = terms(-v.z(), -down.z(), down.dot(v));
  std::array<double, 3> f = {};
  for (std::size_t j = 0; j < f.size(); ++j)
    for (std::size_t k = 0; k < t.size(); ++k) f[j] += fit[j][k] * t[k];
  const Vector3 generic = f[0] * down + f[1] * v - f[2] * Vector3::UnitZ();
  const double pressure = -generic.dot(n);
  if (pressure <= 0.0) return stress;  // sand does not pull
  stress.normal = -pressure * n;
  const Vector3 along = generic - stress.normal;
  const double length = along.norm();
  if (length == 0.0) return stress;
  const double share = std::min(1.0, friction * pressure / length);
  stress.tangent = (along.dot(v) > 0.0 ? -share : share) * along;
  return stress;
}

namespace {

/// Moments of depth by the corner at node a alone, the others being above the surface.
Vector3 corner_moments(const Vector3& depth, int a) {
  const int b = (a + 1) % 3, c = (a + 2) % 3;
  const double along_b = depth[a] / (depth[a] - depth[b]);
  const double along_c = depth[a] / (depth[a] - depth[c]);
  Vector3 moments;
  moments[a] = 4.0 - along_b - along_c;
  moments[b] = along_b;
  moments[c] = along_c;
  return along_b * along_c * depth[a] / 12.0 * moments;
}

}  // namespace

Vector3 depth_moments(const Vector3& depth) {
  const auto below = (depth.array() > 0.0).count();
  if (below == 0) return Vector3::Zero();
  Eigen::Index node = 0;
  if (below == 1) {
    depth.maxCoeff(&node);
    return corner_moments(depth, static_cast<int>(node));
  }
  const Vector3 whole = (depth.array() + depth.sum()) / 12.0;
  if (below == 3) return whole;
  depth.minCoeff(&node);
  if (depth[node] == 0.0) return whole;
  return whole + corner_moments(-depth, static_cast<int>(node));
}

}  // namespace furrow
