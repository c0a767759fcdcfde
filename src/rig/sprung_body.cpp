// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/rig/sprung_body.h"

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

constexpr double largest_step = 0.1;  // dt^2 k/m of a spring whose force is constant over a step

Vector3 lever(const Strut& strut) { return {1.0, strut.arm.y(), -strut.arm.x()}; }

}  // namespace

void SprungBody::advance(std::vector<Strut>& struts, const Vector2& moment, double dt) {
  count_energy(struts);
  Matrix3 system = inertia_.asDiagonal();
  Vector3 force(0.0, moment.x(), moment.y()), stiffness = Vector3::Zero();
  for (Strut& strut : struts) {
    const Vector3 b = lever(strut);
    strut.force = strut.stiffness * (strut.height - b.dot(position_));
    force += b * (strut.force + strut.damping * strut.velocity - strut.weight);
    system += dt * strut.damping * b * b.transpose();
    stiffness += strut.stiffness * b.cwiseAbs2();
  }
  Vector3 impulse = inertia_.cwiseProduct(velocity_) + dt * force;
  const char* const names[] = {"heave", "roll", "pitch"};
  for (int k = 0; k < 3; ++k) {
    if (inertia_[k] == 0.0) {
      system.row(k).setZero();
      system.col(k).setZero();
      system(k, k) = 1.0;
      impulse[k] = 0.0;
    } else if (dt * dt * stiffness[k] > largest_step * inertia_[k]) {
      throw StateError(
          fmt::format("a step of {:g} s is too long for the springs in {}, with a "
                      "natural period of {:.3g} s; write a smaller timestep",
                      dt, names[k], 2.0 * pi * std::sqrt(inertia_[k] / stiffness[k])));
    }
  }
  velocity_ = system.ldlt().solve(impulse);
  turned_ = dt * velocity_;
  moment_ = moment;
  position_ += turned_;
  heights_.clear(), forces_.clear(), dampers_.clear(), weights_.clear(), tops_.clear();
  for (Strut& strut : struts) {
    const Vector3 b = lever(strut);
    strut.top_height = b.dot(position_);
    strut.top_velocity = b.dot(velocity_);
    const double damper = strut.damping * (strut.velocity - strut.top_velocity);
    strut.force += damper;
    heights_.push_back(strut.height);
    forces_.push_back(strut.force);
    dampers_.push_back(damper);
    weights_.push_back(strut.weight);
    tops_.push_back(b.dot(turned_));
  }
}

/// Adds the energies of the last step, when the axles have moved.
void SprungBody::count_energy(const std::vector<Strut>& struts) {
  energy_.spring = 0.0;
  for (std::size_t i = 0; i < struts.size(); ++i) {
    const double squeeze = struts[i].height - lever(struts[i]).dot(position_);
    energy_.spring += 0.5 * struts[i].stiffness * squeeze * squeeze;
    if (forces_.empty()) continue;
    const double rise = struts[i].height - heights_[i];
    energy_.axle_work += forces_[i] * rise;
    energy_.damping_loss += dampers_[i] * (rise - tops_[i]);
    energy_.weight_work -= weights_[i] * tops_[i];
  }
  energy_.moment_work += moment_.dot(turned_.tail<2>());
  energy_.kinetic = 0.5 * inertia_.dot(velocity_.cwiseAbs2());
}

void SprungBody::checkpoint(Checkpoint& state) {
  state.values("position", position_);
  state.values("velocity", velocity_);
  state.values("turned", turned_);
  state.values("moment", moment_);
  state.values("heights", heights_);
  state.values("forces", forces_);
  state.values("dampers", dampers_);
  state.values("weights", weights_);
  state.values("tops", tops_);
  for (double* each : {&energy_.kinetic, &energy_.spring, &energy_.damping_loss,
                       &energy_.weight_work, &energy_.axle_work, &energy_.moment_work})
    state.value("energy", *each);
}

}  // namespace furrow
