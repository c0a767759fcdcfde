// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/geometry/closest_feature.h"

#include <random>

#include <gtest/gtest.h>

namespace furrow::closest_feature_test {
namespace {

/// Independent answer: the smallest of the distances to the plane's foot (if inside) and to the
/// three edges.
double brute_force_distance(const Vector3& p, const std::array<Vector3, 3>& t) {
  const Vector3 n = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
  const Vector3 foot = p - n * n.dot(p - t[0]);
  bool inside = true;
  double best = 1e300;
  for (int i = 0; i < 3; ++i) {
    const Vector3& a = t[static_cast<std::size_t>(i)];
    const Vector3 edge = t[static_cast<std::size_t>((i + 1) % 3)] - a;
    inside &= edge.cross(foot - a).dot(n) >= 0.0;
    const double s = std::clamp(edge.dot(p - a) / edge.squaredNorm(), 0.0, 1.0);
    best = std::min(best, (p - a - s * edge).norm());
  }
  return inside ? std::min(best, (p - foot).norm()) : best;
}

TEST(ClosestPoint, AgreesWithBruteForceForTrianglesOfAnyShape) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto random = [&] {
    return Vector3{uniform(generator), uniform(generator), uniform(generator)};
  };
  for (int i = 0; i < 20000; ++i) {
    std::array<Vector3, 3> t{random(), random(), random()};
    if (i % 3 == 0) t[2] = 0.5 * (t[0] + t[1]) + 0.02 * random();  // very obtuse
    const Vector3 p = 1.5 * random();
    const ClosestPoint c = closest_point_on_triangle(p, t[0], t[1], t[2]);
    ASSERT_NEAR(c.distance, brute_force_distance(p, t), 1e-9);
    ASSERT_NEAR(c.barycentric.sum(), 1.0, 1e-12);
    ASSERT_GE(c.barycentric.minCoeff(), 0.0);
    const Vector3 q = c.barycentric[0] * t[0] + c.barycentric[1] * t[1] + c.barycentric[2] * t[2];
    ASSERT_NEAR((p - q - c.separation).norm(), 0.0, 1e-12);
  }
}

/// Two triangles with the common edge (1, 2), opened by an angle; the sphere's centre above.
std::vector<ContactCandidate> candidates_over_edge(double fold, const Vector3& centre) {
  const Vector3 a(-1, 0, 0), b(0, -1, 0), c(0, 1, 0), d(std::cos(fold), 0, std::sin(fold));
  return {{closest_point_on_triangle(centre, a, b, c), 0, Vector3i(0, 1, 2), 0},
          {closest_point_on_triangle(centre, b, d, c), 1, Vector3i(1, 3, 2), 1}};
}

TEST(ContactSelection, FlatMeshIsOneContact) {
  for (double x : {-0.3, -1e-12, 0.0, 1e-12, 0.3}) {
    std::vector<ContactCandidate> contacts = candidates_over_edge(0.0, Vector3(x, 0.1, 0.2));
    ContactSelection().select(contacts, 0.25);
    ASSERT_EQ(contacts.size(), 1u) << x;
    EXPECT_NEAR(contacts[0].point.distance, 0.2, 1e-12);
  }
}

TEST(ContactSelection, RidgeIsOneContactOnTheEdge) {
  std::vector<ContactCandidate> contacts = candidates_over_edge(-1.0, Vector3(0.02, 0.0, 0.2));
  ContactSelection().select(contacts, 0.25);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].point.feature_nodes(), 2);
}

TEST(ContactSelection, ShallowValleyIsOneContactASharpOneIsTwo) {
  std::vector<ContactCandidate> shallow =
      candidates_over_edge(radians(10), Vector3(-0.03, 0.0, 0.2));
  ContactSelection().select(shallow, 0.25);
  ASSERT_EQ(shallow.size(), 1u);
  EXPECT_EQ(shallow[0].triangle, 0);  // the deeper one
  std::vector<ContactCandidate> sharp = candidates_over_edge(radians(60), Vector3(-0.1, 0.0, 0.2));
  ContactSelection().select(sharp, 0.25);
  EXPECT_EQ(sharp.size(), 2u);
}

}  // namespace
}  // namespace furrow::closest_feature_test
