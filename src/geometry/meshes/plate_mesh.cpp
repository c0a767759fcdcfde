// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/geometry/meshes/plate_mesh.h"

#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "furrow/core/options/check_number.h"
#include "furrow/core/error.h"

namespace furrow {

namespace {

constexpr double minimum_plate_angle = radians(5.0);
constexpr int cone_sides = 12;
// Diameter of a cone's shaft over that of its base: 15.88 and 20.27 mm in the standard ASAE S313.
constexpr double shaft_ratio = 0.783;

/// Radius of the corners of a regular polygon over that of a circle of its area.
double corner_radius(int corners) {
  const double turn = 2.0 * pi / corners;
  return std::sqrt(turn / std::sin(turn));
}

/// A flat face: points of the plane, triangles counter-clockwise, and the nodes of its edge in that
/// sense.
struct Face {
  std::vector<Eigen::Vector2d> points;
  std::vector<Vector3i> triangles;
  std::vector<int> edge;
};

/// Rings of 6 k nodes around one in the middle: all triangles are nearly equilateral.
Face disc(double radius, int rings) {
  const double outer = radius * corner_radius(6 * rings);
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
  const bool annular = plate.shape == PlateShape::annulus;
  if (annular ? !(plate.inner_size > 0.0 && plate.inner_size < plate.size)
              : plate.inner_size != 0.0)
    throw InputError(fmt::format("{}, keyword 'inner_size'", where),
                     fmt::format("is {:g} m", plate.inner_size),
                     annular ? fmt::format("a number in (0, {:g}) [m], for an annulus", plate.size)
                             : "only for 'shape annulus'");
  if (plate.shape == PlateShape::cone)
    check_number(plate.angle, Range::closed(20.0, 120.0), where + ", keyword 'angle'", "degrees");
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

/// A point of the outline of a body of revolution.
struct OutlinePoint {
  double radius, z;  // [m]
};

/// The outline with its edges divided into pieces of a length at most.
std::vector<OutlinePoint> divided(const std::vector<OutlinePoint>& outline, double length,
                                  bool closed) {
  std::vector<OutlinePoint> points;
  const std::size_t edges = outline.size() - (closed ? 0 : 1);
  for (std::size_t i = 0; i < edges; ++i) {
    const OutlinePoint &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const double pieces = std::ceil(std::hypot(b.radius - a.radius, b.z - a.z) / length - 1e-9);
    for (int k = 0; k < static_cast<int>(pieces); ++k)
      points.push_back(
          {a.radius + k / pieces * (b.radius - a.radius), a.z + k / pieces * (b.z - a.z)});
  }
  if (!closed) points.push_back(outline.back());
  return points;
}

/// Turns an outline, counter-clockwise in the plane of radius and z, about the axis. An outline
/// that is not closed has its ends on the axis.
Surface revolved(const std::vector<OutlinePoint>& outline, int sides, bool closed) {
  Surface surface;
  const int count = static_cast<int>(outline.size()), rings = closed ? count : count - 2;
  surface.resize(static_cast<std::size_t>(rings * sides + (closed ? 0 : 2)));
  const auto node = [&](int ring, int i) { return ring * sides + i % sides; };
  const double scale = corner_radius(sides);
  for (int ring = 0; ring < rings; ++ring) {
    const OutlinePoint& point = outline[static_cast<std::size_t>(closed ? ring : ring + 1)];
    for (int i = 0; i < sides; ++i) {
      const double angle = 2.0 * pi * i / sides;
      surface.x.col(node(ring, i)) << scale * point.radius * std::cos(angle),
          scale * point.radius * std::sin(angle), point.z;
    }
  }
  for (int ring = 0; ring < (closed ? rings : rings - 1); ++ring)
    for (int i = 0; i < sides; ++i) {
      const int next = (ring + 1) % rings;
      surface.triangles.emplace_back(node(ring, i), node(ring, i + 1), node(next, i + 1));
      surface.triangles.emplace_back(node(ring, i), node(next, i + 1), node(next, i));
    }
  if (!closed) {
    const int first = rings * sides, last = first + 1;
    surface.x.col(first) << 0.0, 0.0, outline.front().z;
    surface.x.col(last) << 0.0, 0.0, outline.back().z;
    for (int i = 0; i < sides; ++i) {
      surface.triangles.emplace_back(first, node(0, i + 1), node(0, i));
      surface.triangles.emplace_back(last, node(rings - 1, i), node(rings - 1, i + 1));
    }
  }
  return surface;
}

Surface annulus(const PlateGeometry& plate) {
  const double inner = 0.5 * plate.inner_size, outer = 0.5 * plate.size, h = plate.thickness;
  const auto outline = divided({{inner, 0.0}, {outer, 0.0}, {outer, h}, {inner, h}},
                               plate.size / plate.elements, true);
  return revolved(outline, 3 * plate.elements, true);
}

Surface cone(const PlateGeometry& plate) {
  const double base = 0.5 * plate.size, shaft = shaft_ratio * base;
  const double height = base / std::tan(radians(0.5 * plate.angle)), top = height + plate.thickness;
  const auto outline =
      divided({{0.0, 0.0}, {base, height}, {shaft, height}, {shaft, top}, {0.0, top}},
              plate.size / plate.elements, false);
  return revolved(outline, cone_sides, false);
}

Surface mesh_of(const PlateGeometry& plate) {
  switch (plate.shape) {
    case PlateShape::circle:
      return plate_between(disc(0.5 * plate.size, plate.elements / 2), plate.thickness);
    case PlateShape::square:
      return plate_between(square(plate.size, plate.elements), plate.thickness);
    case PlateShape::annulus:
      return annulus(plate);
    case PlateShape::cone:
      break;
  }
  return cone(plate);
}

}  // namespace

double PlateGeometry::area() const {
  if (shape == PlateShape::square) return size * size;
  return pi / 4.0 * (size * size - inner_size * inner_size);
}

Surface make_plate_mesh(const PlateGeometry& plate, const std::string& where) {
  check(plate, where);
  Surface surface = mesh_of(plate);
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
