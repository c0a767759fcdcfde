// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Contact law: springs normal and tangential to the surface, with damping (theory: contact, eqs. 3
/// and 4; limit of stability: theory: contact, eq. 8).

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "furrow/mpm/contact/contact_parameters.h"
#include "furrow/mpm/contact/friction.h"
#include "furrow/mpm/contact/particle_contact.h"
#include "furrow/mpm/particles/particle_group.h"
#include "furrow/mpm/ground/terrain_parameters.h"

namespace furrow {

class PenaltyLaw {
 public:
  static constexpr const char* name = "penalty";
  static constexpr const char* meaning = "springs resist penetration";

  explicit PenaltyLaw(const ContactParameters& parameters)
      : friction_{parameters.friction, parameters.slip_length, parameters.shear_limit},
        stiffness_(parameters.stiffness),
        damping_(parameters.damping) {}

  /// Before all others. Chooses the stiffness, unless it was given: the usual one, or four fifths
  /// of the largest with which the ground's step is stable.
  void fit(const TerrainParameters& terrain, const std::string& where);
  void update_stiffness(const ParticleGroup& group, std::size_t particle,
                        ContactHistory& history) const;
  Vector3 force(const ContactMotion& contact, double dt, ContactHistory& history,
                ContactLosses& losses) const;

 private:
  /// Twice as much changes hub drop, pull and torque of a wheel on sand by less than their errors
  /// over time (inputs/validation/convergence).
  static constexpr double usual_stiffness = 1.6;

  double largest_stiffness(const TerrainParameters& terrain, const std::string& where) const;

  Friction friction_;
  /// Stiffness over (wave modulus) x (cube root of the particle's volume).
  std::optional<double> stiffness_;
  double damping_;                         // of critical
  std::vector<double> unstressed_moduli_;  // wave moduli of the layers at the start [Pa]
};

/// The stiffness follows the modulus of the ground upwards, also from bounce to bounce, from that
/// at the start on. A spring that followed it downwards would be too soft where sand has opened. A
/// loaded spring keeps its energy k (gap^2 + stretch^2)/2: contact gives none to ground that
/// stiffens.
inline void PenaltyLaw::update_stiffness(const ParticleGroup& group, std::size_t particle,
                                         ContactHistory& history) const {
  const double modulus = group.material->moduli(group.particles.state(particle)).wave();
  const double volume = group.particles.data(column::volume)[particle];
  double stiffness =
      *stiffness_ * std::max(modulus, unstressed_moduli_[group.layer]) * std::cbrt(volume);
  if (history.touches() || history.bounces()) {
    stiffness = std::max(stiffness, history.stiffness);
    const double scale = std::sqrt(history.stiffness / stiffness);
    history.gap *= scale;
    history.spring *= scale;
  }
  history.stiffness = stiffness;
}

inline Vector3 PenaltyLaw::force(const ContactMotion& contact, double dt, ContactHistory& history,
                                 ContactLosses& losses) const {
  const Vector3& n = contact.point.normal;
  const double stiffness = history.stiffness;
  const double damping = 2.0 * damping_ * std::sqrt(stiffness * contact.mass);
  const double approach = -contact.velocity.dot(n);
  const double spring_force = -stiffness * contact.point.gap;
  const double normal_force = std::max(0.0, spring_force + damping * approach);
  losses.damping += (normal_force - spring_force) * approach * dt;

  const Vector3 sliding = contact.velocity + approach * n;
  history.spring += contact.last_dt * sliding;
  history.spring -= history.spring.dot(n) * n;
  Vector3 tangential_force = -stiffness * history.spring - damping * sliding;
  // Where friction grows with the slip, every relative motion along the surface counts as slip;
  // with Coulomb's law, only what goes beyond the spring.
  if (friction_.mobilised_by_slip()) history.slip += contact.last_dt * sliding.norm();
  const double limit = friction_.limit(normal_force, history.slip, contact.area);
  const double size = tangential_force.norm();
  if (size > limit) {
    tangential_force *= limit / size;
    const Vector3 held = -tangential_force / stiffness;
    if (!friction_.mobilised_by_slip()) history.slip += (history.spring - held).norm();
    losses.friction += limit * (history.spring - held).norm();
    history.spring = held;
  } else {
    losses.damping += damping * sliding.squaredNorm() * dt;
  }
  return normal_force * n + tangential_force;
}

}  // namespace furrow
