// SPDX-License-Identifier: GPL-2.0-or-later
#include "bodies/rigid_plate.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/error.h"

namespace furrow {

namespace {

constexpr double minimum_plate_angle = radians(5.0);

/// A flat face: points of the plane, triangles counter-clockwise, and the nodes of its edge in that
/// sense.
struct Disc {
  std::vector<Eigen::Vector2d> points;
  std::vector<Vector3i> triangles;
  std::vector<int> edge;
};

/// Rings of 6 k nodes around one in the middle: all triangles are nearly equilateral.
Disc disc(double radius, int rings) {
  // Regular n-gon of the circle's area: n/2 R'^2 sin(2 pi/n) = pi R^2.
  const double n = 6.0 * rings,
               outer = radius * std::sqrt(2.0 * M_PI / (n * std::sin(2.0 * M_PI / n)));
  Disc face;
  const auto first_of = [](int ring) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1); };
  const auto node = [&](int ring, int i) {
    return first_of(ring) + (ring == 0 ? 0 : i % (6 * ring));
  };
  face.points.emplace_back(0.0, 0.0);
  for (int ring = 1; ring <= rings; ++ring)
    for (int i = 0; i < 6 * ring; ++i) {
      const double angle = 2.0 * M_PI * i / (6.0 * ring), r = outer * ring / rings;
      face.points.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
  for (int ring = 1; ring <= rings; ++ring)
    for (int sector = 0; sector < 6; ++sector)
      for (int i = 0; i < ring; ++i) {
        const int out = sector * ring + i, in = sector * (ring - 1) + i;
        face.triangles.emplace_back(node(ring - 1, in), node(ring, out), node(ring, out + 1));
        if (i + 1 < ring)
          face.triangles.emplace_back(node(ring - 1, in), node(ring, out + 1),
                                      node(ring - 1, in + 1));
      }
  for (int i = 0; i < 6 * rings; ++i) face.edge.push_back(node(rings, i));
  return face;
}

Disc square(double side, int elements) {
  Disc face;
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

PlateGeometry geometry_from(const Options& options) {
  PlateGeometry plate;
  plate.shape = options.text("shape") == "circle" ? PlateShape::circle : PlateShape::square;
  plate.size = options.number("size");
  plate.thickness = options.number("thickness");
  plate.elements = static_cast<int>(options.integer("elements"));
  return plate;
}

Vector3 centre_from(const Options& options) {
  const std::vector<double>& centre = options.numbers("centre");
  return {centre[0], centre[1], centre[2]};
}

}  // namespace

double PlateGeometry::area() const {
  return (shape == PlateShape::circle ? M_PI / 4.0 : 1.0) * size * size;
}

Surface make_plate_mesh(const PlateGeometry& plate, const std::string& where) {
  for (const auto& [value, key] :
       {std::pair{plate.size, "size"}, std::pair{plate.thickness, "thickness"}})
    if (!(std::isfinite(value) && value > 0.0))
      throw InputError(fmt::format("{}, keyword '{}'", where, key), fmt::format("is {} m", value),
                       "a number > 0 [m]");
  const bool circle = plate.shape == PlateShape::circle;
  if (plate.elements < 2 || (circle && plate.elements % 2 != 0))
    throw InputError(fmt::format("{}, keyword 'elements'", where),
                     fmt::format("is {}", plate.elements),
                     circle ? "an even number, at least 2" : "at least 2");
  const Disc face =
      circle ? disc(0.5 * plate.size, plate.elements / 2) : square(plate.size, plate.elements);

  Surface surface;
  const int count = static_cast<int>(face.points.size());
  surface.resize(2 * face.points.size());
  for (int i = 0; i < count; ++i) {
    surface.x.col(i) << face.points[static_cast<std::size_t>(i)], 0.0;
    surface.x.col(count + i) << face.points[static_cast<std::size_t>(i)], plate.thickness;
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
  if (surface.minimum_angle() < minimum_plate_angle)
    throw InputError(
        fmt::format("{}, keyword 'elements'", where),
        fmt::format("is {}, which makes slivers at the edge of a plate {} m thick", plate.elements,
                    plate.thickness),
        fmt::format("no corner sharper than {:.0f} degrees", degrees(minimum_plate_angle)),
        "choose elements about as long as the plate is thick");
  return surface;
}

Schema RigidPlate::schema(const std::string& subject) {
  Schema schema(subject);
  schema.choice("shape", {"circle", "square"}, "outline of the plate").by_default("circle");
  schema.number("size", "m", Range::positive(), "diameter of a circle, side of a square");
  schema.number("thickness", "m", Range::positive(), "height of the plate's edge");
  schema.integer("elements", Range::closed(2, 400), "triangles across the plate; even for a circle")
      .by_default("20");
  schema.numbers("centre", 3, "m", Range::any(), "centre of the lower face at the start: x y z");
  return schema;
}

RigidPlate::RigidPlate(const Options& options)
    : RigidPlate(geometry_from(options), centre_from(options), options.subject()) {}

RigidPlate::RigidPlate(const PlateGeometry& geometry, const Vector3& centre,
                       const std::string& where)
    : geometry_(geometry), surface_(make_plate_mesh(geometry, where)), centre_(centre) {
  reference_ = surface_.x;
  place_nodes();
}

void RigidPlate::prescribe(double velocity) {
  if (!std::isfinite(velocity))
    throw StateError(fmt::format("rigid plate: prescribed velocity is {}", velocity));
  velocity_ = velocity;
}

double RigidPlate::mean_pressure() const { return surface_.total_force().z() / geometry_.area(); }

double RigidPlate::stable_time_step() const { return std::numeric_limits<double>::infinity(); }

void RigidPlate::advance(double dt) {
  const double force = surface_.total_force().z();
  if (!std::isfinite(force))
    throw StateError(fmt::format("rigid plate: the force on it is {} N", force));
  contact_work_ += force * velocity_ * dt;
  centre_.z() += velocity_ * dt;
  place_nodes();
}

void RigidPlate::place_nodes() {
  surface_.x = reference_.colwise() + centre_;
  surface_.v.colwise() = Vector3(0.0, 0.0, velocity_);
}

EnergyBudget RigidPlate::energy_budget() const {
  EnergyBudget budget;
  budget.contact_work = contact_work_;
  budget.drive_work = -contact_work_;
  return budget;
}

void RigidPlate::checkpoint(Checkpoint& state) {
  state.match("shape", static_cast<int>(geometry_.shape));
  state.match("size", geometry_.size);
  state.match("thickness", geometry_.thickness);
  state.match("elements", geometry_.elements);
  state.values("centre", centre_);
  state.value("velocity", velocity_);
  state.value("contact_work", contact_work_);
  state.values("nodal_force", surface_.f);
  if (!state.saving()) place_nodes();
}

}  // namespace furrow
