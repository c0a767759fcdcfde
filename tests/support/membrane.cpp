// SPDX-License-Identifier: GPL-2.0-or-later
#include "tests/support/membrane.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

void require(bool good, const char* key, double value, const char* allowed) {
  if (!good)
    throw InputError(fmt::format("membrane, keyword '{}'", key), fmt::format("is {}", value),
                     allowed);
}

}  // namespace

Membrane::Membrane(Surface reference, const MembraneMaterial& material,
                   std::vector<int> fixed_nodes)
    : surface_(std::move(reference)), material_(material) {
  require(material.young > 0.0, "young", material.young, "a number > 0 [Pa]");
  require(material.poisson > -1.0 && material.poisson < 0.5, "poisson", material.poisson,
          "a number in (-1, 0.5)");
  require(material.thickness > 0.0, "thickness", material.thickness, "a number > 0 [m]");
  require(material.density > 0.0, "density", material.density, "a number > 0 [kg/m^3]");
  require(material.damping_rate >= 0.0, "damping_rate", material.damping_rate,
          "a number >= 0 [1/s]");

  const auto nodes = static_cast<Eigen::Index>(surface_.node_count());
  internal_ = pressure_force_ = Matrix3X::Zero(3, nodes);
  mass_ = VectorX::Zero(nodes);
  shortest_altitude_ = std::numeric_limits<double>::max();
  for (std::size_t t = 0; t < surface_.triangle_count(); ++t) {
    const Vector3i& n = surface_.triangles[t];
    const Vector3 e1 = surface_.x.col(n[1]) - surface_.x.col(n[0]),
                  e2 = surface_.x.col(n[2]) - surface_.x.col(n[0]);
    const double area = 0.5 * e1.cross(e2).norm();
    const double longest = std::max({e1.norm(), e2.norm(), (e2 - e1).norm()});
    if (!(area > 1e-12 * longest * longest))
      throw StateError(fmt::format("membrane: triangle {} has no area", t));
    const Vector3 axis1 = e1.normalized(), axis2 = e1.cross(e2).cross(e1).normalized();
    Eigen::Matrix2d edges;
    edges << e1.dot(axis1), e2.dot(axis1), 0.0, e2.dot(axis2);
    Eigen::Matrix<double, 2, 3> natural;
    natural << -1, 1, 0, -1, 0, 1;
    Eigen::Matrix2d inverse_transpose;
    inverse_transpose << edges(1, 1), -edges(1, 0), -edges(0, 1), edges(0, 0);
    inverse_transpose /= edges.determinant();
    elements_.push_back({inverse_transpose * natural, area * material.thickness});
    shortest_altitude_ = std::min(shortest_altitude_, 2.0 * area / longest);
    for (int j = 0; j < 3; ++j) mass_[n[j]] += area * material.thickness * material.density / 3.0;
  }
  mobility_ = mass_.cwiseInverse();
  for (int node : fixed_nodes) mobility_[node] = 0.0;
}

/// Courant limit of the stiffest triangle: altitude over the plane-stress wave speed sqrt(E/(rho (1
/// - nu^2))), with 0.7 in reserve for triangles that are stretched or squeezed.
double Membrane::stable_time_step() const {
  const double wave_speed = std::sqrt(
      material_.young / (material_.density * (1.0 - material_.poisson * material_.poisson)));
  return 0.7 * shortest_altitude_ / wave_speed;
}

void Membrane::compute_forces() {
  const double nu = material_.poisson, stiffness = material_.young / (1.0 - nu * nu);
  internal_.setZero();
  pressure_force_.setZero();
  elastic_energy_ = 0.0;
  for (std::size_t t = 0; t < elements_.size(); ++t) {
    const Vector3i& n = surface_.triangles[t];
    const Element& element = elements_[t];
    Matrix3 x;
    for (int j = 0; j < 3; ++j) x.col(j) = surface_.x.col(n[j]);
    const Eigen::Matrix<double, 3, 2> F = x * element.gradient.transpose();
    const Eigen::Matrix2d G = 0.5 * (F.transpose() * F - Eigen::Matrix2d::Identity());
    const Eigen::Matrix2d S =
        stiffness * ((1.0 - nu) * G + nu * G.trace() * Eigen::Matrix2d::Identity());
    const Matrix3 forces = -element.volume * F * S * element.gradient;  // column j on node j
    const Vector3 push = pressure_ * surface_.area_vector(t) / 3.0;
    for (int j = 0; j < 3; ++j) {
      internal_.col(n[j]) += forces.col(j);
      pressure_force_.col(n[j]) += push;
    }
    elastic_energy_ += 0.5 * element.volume * (S.array() * G.array()).sum();
  }
}

void Membrane::advance(double dt) {
  compute_forces();
  const double decay = std::exp(-material_.damping_rate * dt);
  for (Eigen::Index n = 0; n < surface_.x.cols(); ++n) {
    if (mobility_[n] == 0.0) continue;
    const Vector3 kicked =
        surface_.v.col(n) +
        dt * mobility_[n] * (internal_.col(n) + pressure_force_.col(n) + surface_.f.col(n));
    const Vector3 v = decay * kicked;
    damped_ += 0.5 * mass_[n] * (kicked.squaredNorm() - v.squaredNorm());
    // makes the kinetic energy balance of the kick exact
    const Vector3 mean = 0.5 * (surface_.v.col(n) + kicked);
    contact_work_ += dt * surface_.f.col(n).dot(mean);
    pressure_work_ += dt * pressure_force_.col(n).dot(mean);
    surface_.v.col(n) = v;
    surface_.x.col(n) += dt * v;
  }
  surface_.check_finite("membrane");
}

EnergyBudget Membrane::energy_budget() const {
  EnergyBudget budget;
  for (Eigen::Index n = 0; n < surface_.x.cols(); ++n) {
    budget.momentum += mass_[n] * surface_.v.col(n);
    budget.kinetic_energy += 0.5 * mass_[n] * surface_.v.col(n).squaredNorm();
  }
  budget.stored_energy = elastic_energy_;
  budget.dissipated_energy = damped_;
  budget.contact_work = contact_work_;
  budget.load_work = pressure_work_;
  return budget;
}

void Membrane::checkpoint(Checkpoint& state) {
  state.values("position", surface_.x);
  state.values("velocity", surface_.v);
  state.value("pressure", pressure_);
  state.value("contact_work", contact_work_);
  state.value("pressure_work", pressure_work_);
  state.value("damped", damped_);
}

}  // namespace furrow
