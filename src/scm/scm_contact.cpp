// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/scm/scm_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "furrow/scm/contact_width.h"

namespace furrow {

namespace {

constexpr double full = 1.0 - 1e-9;  // of the area of a cell

template <class Test>
bool any_of(const SoilPatches& soils, Test test) {
  return std::any_of(soils.all().begin(), soils.all().end(), test);
}

}  // namespace

ScmContact::ScmContact(Body& body, HeightField& field, SoilPatches soils, const Settings& settings)
    : body_(body), field_(field), soils_(std::move(soils)), settings_(settings) {
  const auto triangles = static_cast<Eigen::Index>(body.surface().triangle_count());
  mobilised_ = Eigen::Matrix2Xd::Zero(2, triangles);
  sheared_area_ = next_area_ = VectorX::Zero(triangles);
}

void ScmContact::apply(double dt) {
  footprint_.find(body_.surface(), field_);
  step_ = Step();
  find_contacts();
  find_descent();
  press(dt);
  shear(dt);
  if (any_of(soils_, [](const Soil& soil) { return soil.flow > 0.0; })) move_soil();
}

void ScmContact::find_contacts() {
  const Footprint::Cells& cells = footprint_.cells();
  touches_.assign(cells.size(), 0);
  for (std::size_t s = 0; s < cells.size(); ++s)
    if (cells.height[s] < field_.surface(cells.cell[s])) {
      touches_[s] = 1;
      step_.area += cells.area[s];
    }
}

/// Mean over the cell of v . n/|n_z|, the velocity at which the surface of the body sinks, for the
/// damping.
void ScmContact::find_descent() {
  const Footprint::Cells& cells = footprint_.cells();
  const Footprint::Pieces& pieces = footprint_.pieces();
  const Surface& surface = body_.surface();
  descent_.assign(cells.size(), 0.0);
  if (!any_of(soils_, [](const Soil& soil) { return soil.damping > 0.0; })) return;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const auto s = static_cast<std::size_t>(pieces.slot[p]);
    if (!touches_[s]) continue;
    const Vector3 normal = surface.area_vector(static_cast<std::size_t>(pieces.triangle[p]));
    descent_[s] -= pieces.area[p] / cells.area[s] * place_of(p, surface.v).dot(normal) / normal.z();
  }
}

/// Elastic up to Bekker's pressure, which depends on the sinkage (theory: scm, eq. 1).
void ScmContact::press(double dt) {
  const Footprint::Cells& cells = footprint_.cells();
  pressure_.assign(cells.size(), 0.0);
  pressed_.assign(cells.size(), 0.0);
  if (step_.area == 0.0) return;
  if (any_of(soils_, [](const Soil& soil) { return soil.k_c != 0.0; }))
    step_.width = settings_.width ? *settings_.width : patch_width();
  for (std::size_t s = 0; s < cells.size(); ++s) {
    if (!touches_[s]) continue;
    const std::size_t cell = cells.cell[s];
    const Soil& soil = soil_below(s);
    const double modulus = soil.modulus(step_.width), stiffness = soil.stiffness;
    const double sinkage = field_.reference(cell) - cells.height[s];
    double pressure = stiffness * (field_.surface(cell) - cells.height[s]);
    const double yield = modulus * std::pow(sinkage, soil.n);
    if (pressure > yield) {
      pressure = yield;
      const double height = cells.height[s] + pressure / stiffness;
      pressed_[s] = field_.surface(cell) - height;
      field_.press(cell, height);
      losses_.compaction += cells.area[s] * pressure * pressed_[s];
    }
    step_.stored += 0.5 * cells.area[s] * pressure * pressure / stiffness;
    pressure_[s] = std::max(0.0, pressure + soil.damping * descent_[s]);
    losses_.damping += cells.area[s] * (pressure_[s] - pressure) * descent_[s] * dt;
    step_.pressure = std::max(step_.pressure, pressure_[s]);
    step_.sinkage = std::max(step_.sinkage, sinkage);
  }
}

/// Contact width of the patch; in a half model of the patch and its image in y = 0.
double ScmContact::patch_width() {
  const Footprint::Pieces& pieces = footprint_.pieces();
  points_.clear();
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const auto s = static_cast<std::size_t>(pieces.slot[p]);
    if (!touches_[s] || is_inside(s)) continue;
    for (std::size_t k = pieces.outline[p]; k < pieces.outline[p + 1]; ++k) {
      points_.push_back(pieces.corners[k]);
      if (body_.half_model()) points_.emplace_back(pieces.corners[k].x(), -pieces.corners[k].y());
    }
  }
  const double area = (body_.half_model() ? 2.0 : 1.0) * step_.area;
  return contact_width(area, hull_perimeter(points_, hull_));
}

/// True if a cell is covered and all around it are in contact: it has no corner of the hull.
bool ScmContact::is_inside(std::size_t slot) const {
  if (footprint_.cells().area[slot] < full * field_.cell_area()) return false;
  const std::size_t cell = footprint_.cells().cell[slot];
  const auto columns = static_cast<std::size_t>(field_.columns());
  const std::size_t column = cell % columns;
  if (column == 0 || column + 1 == columns || cell < columns || cell + columns >= field_.cells())
    return false;
  for (const std::size_t next : {cell - 1, cell + 1, cell - columns, cell + columns}) {
    const int other = footprint_.slot(next);
    if (other < 0 || !touches_[static_cast<std::size_t>(other)]) return false;
  }
  return true;
}

Vector3 ScmContact::place_of(std::size_t piece, const Matrix3X& nodal) const {
  const Footprint::Pieces& pieces = footprint_.pieces();
  const Vector3i& nodes =
      body_.surface().triangles[static_cast<std::size_t>(pieces.triangle[piece])];
  const double b = pieces.weight_b[piece], c = pieces.weight_c[piece];
  return (1.0 - b - c) * nodal.col(nodes[0]) + b * nodal.col(nodes[1]) + c * nodal.col(nodes[2]);
}

/// Shear length of the soils below a triangle, weighted by their area [m].
double ScmContact::shear_length(std::size_t first, std::size_t end) const {
  if (soils_.all().size() == 1) return soils_.all().front().shear_length;
  const Footprint::Pieces& pieces = footprint_.pieces();
  double area = 0.0, sum = 0.0;
  for (std::size_t p = first; p < end; ++p) {
    const auto s = static_cast<std::size_t>(pieces.slot[p]);
    if (!touches_[s]) continue;
    area += pieces.area[p];
    sum += pieces.area[p] * soil_below(s).shear_length;
  }
  return sum / area;
}

/// Forces of pressure and shear, triangle by triangle.
void ScmContact::shear(double dt) {
  const Footprint::Pieces& pieces = footprint_.pieces();
  next_area_.setZero();
  for (std::size_t first = 0; first < pieces.size();) {
    std::size_t end = first;
    while (end < pieces.size() && pieces.triangle[end] == pieces.triangle[first]) ++end;
    shear_triangle(first, end, dt);
    first = end;
  }
  sheared_area_.swap(next_area_);
}

/// The mobilised share m of the shear strength follows the sliding velocity v of the triangle,
/// dm/dt = |v|/K (-v/|v| - m) (theory: scm, eq. 4). It is the mean over the area in
/// contact: new area comes without shear.
void ScmContact::shear_triangle(std::size_t first, std::size_t end, double dt) {
  const Footprint::Pieces& pieces = footprint_.pieces();
  Surface& surface = body_.surface();
  const int triangle = pieces.triangle[first];
  const Vector3i& nodes = surface.triangles[static_cast<std::size_t>(triangle)];
  const Vector3 vector = surface.area_vector(static_cast<std::size_t>(triangle));
  const Vector3 normal = vector.normalized();
  const double slope = 1.0 / std::abs(normal.z());  // area over that seen from above
  const bool steep = slope > std::hypot(1.0, Footprint::highest_piece);
  double area = 0.0;
  Vector3 velocity = Vector3::Zero();
  for (std::size_t p = first; p < end; ++p) {
    if (!touches_[static_cast<std::size_t>(pieces.slot[p])]) continue;
    area += slope * pieces.area[p];
    velocity += slope * pieces.area[p] * place_of(p, surface.v);
  }
  if (area == 0.0) return;
  velocity /= area;
  const Vector3 along = (surface.x.col(nodes[1]) - surface.x.col(nodes[0])).normalized();
  const Vector3 across = normal.cross(along);
  const Vector2 sliding(velocity.dot(along), velocity.dot(across));
  auto mobilised = mobilised_.col(triangle);
  mobilised *= std::min(1.0, sheared_area_[triangle] / area);
  if (const double speed = sliding.norm(); speed > 0.0) {
    const Vector2 limit = -sliding / speed;
    const double length = settings_.slip_length ? *settings_.slip_length : shear_length(first, end);
    mobilised = length > 0.0 ? limit + std::exp(-speed * dt / length) * (mobilised - limit) : limit;
  }
  next_area_[triangle] = area;
  const Vector3 direction = mobilised[0] * along + mobilised[1] * across;
  const Soil* soil = nullptr;  // of the last piece
  double slope_of_strength = 0.0;
  ContactRecord* const record = settings_.records ? body_.contact_record() : nullptr;
  for (std::size_t p = first; p < end; ++p) {
    const auto s = static_cast<std::size_t>(pieces.slot[p]);
    if (!touches_[s]) continue;
    const double of_piece = slope * pieces.area[p];
    if (const Soil& below = soil_below(s); &below != soil) {
      soil = &below;
      slope_of_strength = std::tan(below.friction_angle);
    }
    double strength = soil->cohesion + pressure_[s] * slope_of_strength;
    if (const double friction = pressure_[s] * settings_.friction; friction < strength)
      strength = friction;
    const Vector3 shear_force = of_piece * strength * direction;
    const Vector3 force = shear_force - of_piece * pressure_[s] * normal;
    const Vector3 moving = place_of(p, surface.v);
    const double b = pieces.weight_b[p], c = pieces.weight_c[p];
    surface.f.col(nodes[0]) += (1.0 - b - c) * force;
    surface.f.col(nodes[1]) += b * force;
    surface.f.col(nodes[2]) += c * force;
    step_.force += force;
    if (steep) step_.of_steep_faces += force;
    losses_.shear -= shear_force.dot(moving) * dt;
    if (record)
      record->add(place_of(p, surface.x), (body_.half_model() ? 2.0 : 1.0) * force, moving, dt);
  }
}

/// Moves the displaced soil of each column across the travel, half to either side. In a half model
/// all goes to the side that is computed.
void ScmContact::move_soil() {
  const Footprint::Cells& cells = footprint_.cells();
  if (cells.size() == 0) return;
  const auto columns = static_cast<std::size_t>(field_.columns());
  flow_.resize(columns);
  int first = field_.columns(), last = -1;
  for (std::size_t s = 0; s < cells.size(); ++s) {
    if (!touches_[s]) continue;
    const int column = static_cast<int>(cells.cell[s] % columns);
    const int row = static_cast<int>(cells.cell[s] / columns);
    Column& flow = flow_[static_cast<std::size_t>(column)];
    if (flow.highest < 0) flow = {0.0, row, row};
    flow.volume += soil_below(s).flow * pressed_[s] * field_.cell_area();
    flow.lowest = std::min(flow.lowest, row);
    flow.highest = std::max(flow.highest, row);
    first = std::min(first, column);
    last = std::max(last, column);
  }
  const bool half = body_.half_model();
  for (int column = first; column <= last; ++column) {
    Column& flow = flow_[static_cast<std::size_t>(column)];
    const double height = (half ? 1.0 : 0.5) * flow.volume / field_.cell_area();
    if (height > 0.0) {
      const std::size_t cell = field_.index(column, flow.lowest);
      const double slope = std::tan(soils_.at(field_.centre(cell)).friction_angle);
      field_.deposit(column, std::min(flow.highest + 1, field_.rows() - 1), 1, height, slope);
      if (!half) field_.deposit(column, std::max(flow.lowest - 1, 0), -1, height, slope);
    }
    flow = Column();
  }
}

void ScmContact::checkpoint(Checkpoint& state) {
  state.match("triangles", body_.surface().triangle_count());
  state.values("mobilised", mobilised_);
  state.values("sheared_area", sheared_area_);
  state.value("compaction", losses_.compaction);
  state.value("shear", losses_.shear);
  state.value("damping", losses_.damping);
  state.values("force", step_.force);
  state.value("area", step_.area);
  state.value("width", step_.width);
  state.value("pressure", step_.pressure);
  state.value("sinkage", step_.sinkage);
  state.value("stored", step_.stored);
}

}  // namespace furrow
