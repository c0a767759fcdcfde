// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/plate_mesh.h"

#include <cmath>

#include <fmt/format.h>

#include "core/check_number.h"
#include "core/error.h"

namespace furrow {

namespace {

constexpr double minimum_plate_angle = radians(5.0);

/// A flat face: points of the plane, triangles counter-clockwise, and the nodes of its edge in that
/// sense.
struct Face {
  std::vector<Eigen::Vector2d> points;
  std::vector<Vector3i> triangles;
  std::vector<int> edge;
};

/// Rings of 6 k nodes around one in the middle: all triangles are nearly equilateral.
Face disc(double radius, int rings) {
  // Regular n-gon of the circle's area: n/2 R'^2 sin(2 pi/n) = pi R^2.
  const double n = 6.0 * rings;
  const double outer = radius * std::sqrt(2.0 * pi / (n * std::sin(2.0 * pi / n)));
  Face face;
  const auto first_of = [](int ring) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1); };
  const auto node = [&](int ring, int i) {
    return first_of(ring) + (ring == 0 ? 0 : i % (6 * ring));
  };
  face.points.emplace_back(0.0, 0.0);
  for (int ring = 1; ring <= rings; ++ring)
    for (int i = 0; i < 6 * ring; ++i) {
      const double angle = 2.0 * pi * i / (6.0 * ring);
      const double r = outer * ring / rings;
      face.points.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
  for (int ring = 1; ring <= rings; ++ring)
    for (int sector = 0; sector < 6; ++sector)
      for (int i = 0; i < ring; ++i) {
        const int out = sector * ring + i;
        const int in = sector * (ring - 1) + i;
        face.triangles.emplace_back(node(ring - 1, in), node(ring, out), node(ring, out + 1));
        if (i + 1 < ring)
          face.triangles.emplace_back(node(ring - 1, in), node(ring, out + 1),
                                      node(ring - 1, in + 1));
      }
  for (int i = 0; i < 6 * rings; ++i) face.edge.push_back(node(rings, i));
  return face;
}

Face square(double side, int elements) {
  Face face;
  const auto node = [&](int i, int j) { return j * (elements + 1) + i; };
  for (int j = 0; j <= elements; ++j)
    for (int i = 0; i <= elements; ++i)
      face.points.emplace_back(side * (double(i) / elements - 0.5),
                               side * (double(j) / elements - 0.5));
  for (int j = 0; j < elements; ++j)
    for (int i = 0; i < elements; ++i) {
      face.triangles.emplace_back(node(i, j), node(i + 1, j), node(i + 1, j + 1));
      face.triangles.emplace_back(node(i, j), node(i + 1, j + 1), node(i, j + 1));
    }
  for (int i = 0; i < elements; ++i) face.edge.push_back(node(i, 0));
  for (int i = 0; i < elements; ++i) face.edge.push_back(node(elements, i));
  for (int i = elements; i > 0; --i) face.edge.push_back(node(i, elements));
  for (int i = elements; i > 0; --i) face.edge.push_back(node(0, i));
  return face;
}

void check(const PlateGeometry& plate, const std::string& where) {
  check_number(plate.size, Range::positive(), where + ", keyword 'size'", "m");
  check_number(plate.thickness, Range::positive(), where + ", keyword 'thickness'", "m");
  const bool circle = plate.shape == PlateShape::circle;
  if (plate.elements < 2 || (circle && plate.elements % 2 != 0))
    throw InputError(fmt::format("{}, keyword 'elements'", where),
                     fmt::format("is {}", plate.elements),
                     circle ? "an even number, at least 2" : "at least 2");
}

/// The face below, the same face above, and the sides between their edges.
Surface plate_between(const Face& face, double thickness) {
  Surface surface;
  const int count = static_cast<int>(face.points.size());
  surface.resize(2 * face.points.size());
  for (int i = 0; i < count; ++i) {
    surface.x.col(i) << face.points[static_cast<std::size_t>(i)], 0.0;
    surface.x.col(count + i) << face.points[static_cast<std::size_t>(i)], thickness;
  }
  for (const Vector3i& t : face.triangles) {
    surface.triangles.emplace_back(t[0], t[2], t[1]);  // lower face: seen from below
    surface.triangles.emplace_back(count + t[0], count + t[1], count + t[2]);
  }
  for (std::size_t i = 0; i < face.edge.size(); ++i) {
    const int a = face.edge[i], b = face.edge[(i + 1) % face.edge.size()];
    surface.triangles.emplace_back(a, b, count + b);
    surface.triangles.emplace_back(a, count + b, count + a);
  }
  return surface;
}

}  // namespace

double PlateGeometry::area() const {
  return (shape == PlateShape::circle ? pi / 4.0 : 1.0) * size * size;
}

Surface make_plate_mesh(const PlateGeometry& plate, const std::string& where) {
  check(plate, where);
  const Face face = plate.shape == PlateShape::circle ? disc(0.5 * plate.size, plate.elements / 2)
                                                      : square(plate.size, plate.elements);
  Surface surface = plate_between(face, plate.thickness);
  if (surface.minimum_angle() < minimum_plate_angle)
    throw InputError(
        fmt::format("{}, keyword 'elements'", where),
        fmt::format("is {}, which makes slivers at the edge of a plate {} m thick", plate.elements,
                    plate.thickness),
        fmt::format("no corner sharper than {:.0f} degrees", degrees(minimum_plate_angle)),
        "choose elements about as long as the plate is thick");
  return surface;
}

}  // namespace furrow
