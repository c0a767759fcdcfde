// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/geometry/triangle_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace furrow {

namespace {

constexpr int max_bins = 200;  // in one direction

}  // namespace

TriangleSearch::TriangleSearch(const Surface& surface, double reach, const Vector3& lower,
                               const Vector3& upper) {
  const auto [low, high] = surface.bounds();
  lower_ = lower.cwiseMax((low.array() - reach).matrix());
  upper_ = upper.cwiseMin((high.array() + reach).matrix());
  if (!((upper_ - lower_).minCoeff() >= 0.0)) {
    upper_ = lower_.array() - 1.0;  // the search covers nothing
    return;
  }
  const double edge =
      std::sqrt(surface.total_area() / static_cast<double>(surface.triangle_count()));
  const double length = std::max({reach, edge, (upper_ - lower_).maxCoeff() / max_bins});
  per_length_ = 1.0 / length;
  for (int a = 0; a < 3; ++a)
    count_[a] = 1 + static_cast<int>((upper_[a] - lower_[a]) * per_length_);
  const std::size_t bins = static_cast<std::size_t>(count_[0]) *
                           static_cast<std::size_t>(count_[1]) *
                           static_cast<std::size_t>(count_[2]);
  start_.assign(bins + 1, 0);
  const auto visit = [&](auto action) {
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
      const Vector3i& n = surface.triangles[t];
      const Vector3 a = surface.x.col(n[0]), b = surface.x.col(n[1]), c = surface.x.col(n[2]);
      const Vector3 from = (a.cwiseMin(b).cwiseMin(c).array() - reach).matrix(),
                    to = (a.cwiseMax(b).cwiseMax(c).array() + reach).matrix();
      if ((from.array() > upper_.array()).any() || (to.array() < lower_.array()).any()) continue;
      Vector3i first, last;
      for (int d = 0; d < 3; ++d) {
        first[d] = std::clamp(static_cast<int>(std::floor((from[d] - lower_[d]) * per_length_)), 0,
                              count_[d] - 1);
        last[d] = std::clamp(static_cast<int>(std::floor((to[d] - lower_[d]) * per_length_)), 0,
                             count_[d] - 1);
      }
      for (int i = first[0]; i <= last[0]; ++i)
        for (int j = first[1]; j <= last[1]; ++j)
          for (int k = first[2]; k <= last[2]; ++k)
            action(static_cast<std::size_t>((i * count_[1] + j) * count_[2] + k),
                   static_cast<int>(t));
    }
  };
  visit([&](std::size_t bin, int) { ++start_[bin + 1]; });
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  triangles_.resize(start_.back());
  std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
  visit([&](std::size_t bin, int t) { triangles_[next[bin]++] = t; });
}

std::size_t TriangleSearch::bin(const Vector3& point) const {
  std::size_t at = 0;
  for (int a = 0; a < 3; ++a) {
    const int i =
        std::clamp(static_cast<int>((point[a] - lower_[a]) * per_length_), 0, count_[a] - 1);
    at = at * static_cast<std::size_t>(count_[a]) + static_cast<std::size_t>(i);
  }
  return at;
}

std::pair<const int*, const int*> TriangleSearch::near(const Vector3& point) const {
  if (!covers(point)) return {nullptr, nullptr};
  const std::size_t at = bin(point);
  return {triangles_.data() + start_[at], triangles_.data() + start_[at + 1]};
}

NodeTriangles::NodeTriangles(const Surface& surface) : start_(surface.node_count() + 1, 0) {
  for (const Vector3i& t : surface.triangles)
    for (int c = 0; c < 3; ++c) ++start_[static_cast<std::size_t>(t[c]) + 1];
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  triangles_.resize(start_.back());
  std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
  for (std::size_t t = 0; t < surface.triangle_count(); ++t)
    for (int c = 0; c < 3; ++c)
      triangles_[next[static_cast<std::size_t>(surface.triangles[t][c])]++] = static_cast<int>(t);
}

Vector3 NodeTriangles::outward(const Surface& surface, std::size_t triangle,
                               const Vector3& barycentric) const {
  const Vector3i& own = surface.triangles[triangle];
  const int features = (barycentric[0] > 0.0) + (barycentric[1] > 0.0) + (barycentric[2] > 0.0);
  if (features == 3) return surface.area_vector(triangle);
  int carrier[2] = {-1, -1}, found = 0;
  for (int c = 0; c < 3; ++c)
    if (barycentric[c] > 0.0) carrier[found++] = own[c];
  Vector3 sum = Vector3::Zero();
  const auto node = static_cast<std::size_t>(carrier[0]);
  for (std::size_t n = start_[node]; n < start_[node + 1]; ++n) {
    const auto t = static_cast<std::size_t>(triangles_[n]);
    const Vector3i& nodes = surface.triangles[t];
    const Vector3 normal = surface.area_vector(t).normalized();
    if (features == 2) {
      if ((nodes.array() == carrier[1]).any()) sum += normal;
      continue;
    }
    const int corner = nodes[0] == carrier[0] ? 0 : nodes[1] == carrier[0] ? 1 : 2;
    const Vector3 at = surface.x.col(nodes[corner]);
    const Vector3 one = (surface.x.col(nodes[(corner + 1) % 3]) - at).normalized(),
                  two = (surface.x.col(nodes[(corner + 2) % 3]) - at).normalized();
    sum += std::acos(std::clamp(one.dot(two), -1.0, 1.0)) * normal;
  }
  return sum;
}

bool encloses(const Surface& surface, const Vector3& point) {
  // through no node or edge of a regular mesh
  const Vector3 ray = Vector3(0.0123456, 0.0345678, 1.0);
  bool inside = false;
  for (const Vector3i& n : surface.triangles) {
    // Moeller and Trumbore, J. Graphics Tools 2, 1997
    const Vector3 a = surface.x.col(n[0]), e1 = surface.x.col(n[1]) - a,
                  e2 = surface.x.col(n[2]) - a;
    const Vector3 h = ray.cross(e2);
    const double determinant = e1.dot(h);
    if (determinant == 0.0) continue;
    const Vector3 s = point - a, q = s.cross(e1);
    const double u = s.dot(h) / determinant, v = ray.dot(q) / determinant;
    if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && e2.dot(q) / determinant > 0.0) inside = !inside;
  }
  return inside;
}

}  // namespace furrow
