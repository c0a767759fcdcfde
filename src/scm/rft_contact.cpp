// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/scm/rft_contact.h"

#include <algorithm>
#include <cmath>

#include "furrow/scm/rft_law.h"

namespace furrow {

RftContact::RftContact(Body& body, const HeightField& field, const Settings& settings)
    : body_(body), field_(field), settings_(settings) {
  const Surface& surface = body.surface();
  depth_ = VectorX::Zero(surface.x.cols());
  direction_ = Matrix3X::Zero(3, static_cast<Eigen::Index>(surface.triangle_count()));
  for (const Vector3i& nodes : surface.triangles)
    for (int k = 0; k < 3; ++k)
      longest_edge_ = std::max(
          longest_edge_, (surface.x.col(nodes[k]) - surface.x.col(nodes[(k + 1) % 3])).norm());
}

void RftContact::apply(double dt) {
  step_ = Step();
  find_depths();
  const Surface& surface = body_.surface();
  for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
    const Vector3i& nodes = surface.triangles[t];
    if (std::max({depth_[nodes[0]], depth_[nodes[1]], depth_[nodes[2]]}) > 0.0)
      press(t, dt);
    else
      direction_.col(static_cast<Eigen::Index>(t)).setZero();
  }
}

void RftContact::find_depths() {
  const Matrix3X& x = body_.surface().x;
  const Vector2 &lower = field_.lower(), upper = field_.upper();
  for (Eigen::Index node = 0; node < x.cols(); ++node) {
    const double above = x(2, node) - field_.highest();
    if (above > longest_edge_) {  // no triangle reaches the sand
      depth_[node] = -above;
      continue;
    }
    const Vector2 place = x.col(node).head<2>();
    if (above >= 0.0) {  // a body above the sand may leave the field
      depth_[node] = field_.height(place.cwiseMax(lower).cwiseMin(upper)) - x(2, node);
      continue;
    }
    if ((place.array() < lower.array()).any() || (place.array() > upper.array()).any())
      field_.refuse_edge(place);
    depth_[node] = field_.height(place) - x(2, node);
    step_.sinkage = std::max(step_.sinkage, depth_[node]);
  }
}

/// The direction d of a triangle follows its velocity v, dd/dt = |v|/K (v/|v| - d) (theory: rft,
/// eq. 3). Its length is the mobilised share of the resistance.
void RftContact::press(std::size_t triangle, double dt) {
  Surface& surface = body_.surface();
  const Vector3i& nodes = surface.triangles[triangle];
  const Vector3 moments =
      depth_moments(Vector3(depth_[nodes[0]], depth_[nodes[1]], depth_[nodes[2]]));
  const double depth = moments.sum();
  if (depth <= 0.0) return;  // touched by a node at the surface
  const Vector3 weights = moments / depth;
  const auto at_the_force = [&](const Matrix3X& nodal) -> Vector3 {
    return weights[0] * nodal.col(nodes[0]) + weights[1] * nodal.col(nodes[1]) +
           weights[2] * nodal.col(nodes[2]);
  };
  const Vector3 velocity = at_the_force(surface.v);
  auto direction = direction_.col(static_cast<Eigen::Index>(triangle));
  if (const double speed = velocity.norm(); speed > 0.0) {
    const Vector3 limit = velocity / speed;
    direction = limit + std::exp(-speed * dt / settings_.slip_length) * (direction - limit);
  }
  const double share = direction.norm();
  if (share == 0.0) return;
  const Vector3 vector = surface.area_vector(triangle);
  const double area = vector.norm();
  const RftStress stress =
      rft_stress(vector / area, Vector3(direction / share), settings_.friction);
  const double scale = share * settings_.strength * depth;
  const Vector3 pressure = scale * area * stress.normal, shear = scale * area * stress.tangent;
  const Vector3 force = pressure + shear;
  if (force.isZero(0.0)) return;
  for (int k = 0; k < 3; ++k) surface.f.col(nodes[k]) += weights[k] * force;
  step_.force += force;
  step_.area += area;
  step_.pressure = std::max(step_.pressure, scale * stress.normal.norm());
  losses_.pressure -= pressure.dot(velocity) * dt;
  losses_.shear -= shear.dot(velocity) * dt;
  ContactRecord* const record = settings_.records ? body_.contact_record() : nullptr;
  if (record) record->add(at_the_force(surface.x), force, velocity, dt);
}

void RftContact::checkpoint(Checkpoint& state) {
  state.match("triangles", body_.surface().triangle_count());
  state.match("strength", settings_.strength);
  state.match("friction", settings_.friction);
  state.match("slip_length", settings_.slip_length);
  state.values("direction", direction_);
  state.value("pressure_work", losses_.pressure);
  state.value("shear_work", losses_.shear);
  state.values("force", step_.force);
  state.value("area", step_.area);
  state.value("pressure", step_.pressure);
  state.value("sinkage", step_.sinkage);
}

}  // namespace furrow
