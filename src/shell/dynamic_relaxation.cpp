// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/shell/dynamic_relaxation.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "furrow/core/smooth_step.h"

namespace furrow {

namespace {

// Weight of the unbalanced force on the support among those on single nodes
constexpr double support_share = 0.1;

}  // namespace

DynamicRelaxation::DynamicRelaxation(RelaxingStructure& structure, const RelaxationSupport& support,
                                     const RelaxationSettings& settings)
    : structure_(structure),
      nodes_(structure.nodes()),
      support_(support),
      settings_(settings),
      start_height_(support.height),
      loading_steps_(std::lround(settings.loading_time / settings.time_step)),
      rotation_length_(std::sqrt(nodes_.inertia.sum() / nodes_.mass.sum())) {}

Relaxation DynamicRelaxation::run() {
  disturb();
  for (; result_.steps < settings_.max_steps; ++result_.steps) {
    compute_forces();
    if (at_rest()) {
      result_.converged = true;
      break;
    }
    kick();
    if (loading())
      damp_loading();
    else if (damp_relaxation())
      continue;
    drift();
  }
  nodes_.stop();
  result_.stops = kinetic_damping_.stops();
  return result_;
}

void DynamicRelaxation::disturb() {
  if (settings_.disturbance == 0.0) return;
  std::minstd_rand random(1);
  std::uniform_real_distribution<double> velocity(-settings_.disturbance, settings_.disturbance);
  for (Eigen::Index n = 0; n < nodes_.count(); ++n)
    for (int k = 0; k < 3; ++k) nodes_.v(k, n) += nodes_.free_to_move(k, n) * velocity(random);
}

double DynamicRelaxation::applied(double time) const {
  return smooth_step(time / settings_.loading_time);
}

void DynamicRelaxation::compute_forces() {
  const double imbalance = structure_.compute_forces();
  support_force_ = support_.motion == RelaxationSupport::Motion::free ? imbalance : 0.0;
  if (result_.steps == 0) initial_imbalance_ = support_force_;
  if (loading()) support_force_ -= initial_imbalance_ * (1.0 - applied(time()));
  result_.residual = std::max(nodes_.largest_unbalanced(rotation_length_),
                              support_share * std::abs(support_force_)) /
                     settings_.force_scale;
}

bool DynamicRelaxation::at_rest() const {
  return !loading() && structure_.carries_its_load(settings_.tolerance) &&
         result_.residual < settings_.tolerance;
}

void DynamicRelaxation::kick() {
  nodes_.kick(settings_.time_step);
  support_velocity_ += settings_.time_step * support_force_ / support_.mass;
}

void DynamicRelaxation::damp_loading() {
  const double dt = settings_.time_step;
  if (support_.motion == RelaxationSupport::Motion::prescribed) {
    const double next = start_height_ + (support_.target - start_height_) * applied(time() + dt);
    support_velocity_ = (next - support_.height) / dt;
  }
  nodes_.v *= 1.0 - settings_.loading_damping * dt;
  nodes_.v.row(2).array() += settings_.loading_damping * dt * support_velocity_;
  nodes_.w *= 1.0 - settings_.loading_damping * dt;
  if (support_.motion == RelaxationSupport::Motion::free)
    support_velocity_ *= 1.0 - support_.damping * dt;
}

/// True when all motion was stopped.
bool DynamicRelaxation::damp_relaxation() {
  const double dt = settings_.time_step;
  nodes_.v *= 1.0 - settings_.relaxation_damping * dt;
  nodes_.w *= 1.0 - settings_.relaxation_damping * dt;
  if (support_.motion != RelaxationSupport::Motion::free) support_velocity_ = 0.0;
  const double energy =
      nodes_.kinetic_energy() + 0.5 * support_.mass * support_velocity_ * support_velocity_;
  if (!kinetic_damping_.peaked(energy)) return false;
  nodes_.stop();
  support_velocity_ = 0.0;
  return true;
}

void DynamicRelaxation::drift() {
  nodes_.drift(settings_.time_step);
  support_.height += settings_.time_step * support_velocity_;
  structure_.follow(support_.height);
}

}  // namespace furrow
