// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Contact law: an impulse stops the approach of the particle's mass and removes a part of the
/// penetration within the step (theory: contact, eq. 6).

#include <algorithm>
#include <string>

#include "furrow/mpm/contact/contact_parameters.h"
#include "furrow/mpm/contact/friction.h"
#include "furrow/mpm/contact/particle_contact.h"
#include "furrow/mpm/particles/particle_group.h"
#include "furrow/mpm/ground/terrain_parameters.h"

namespace furrow {

class ImpulseLaw {
 public:
  static constexpr const char* name = "impulse";
  static constexpr const char* meaning = "an impulse stops the approach within the step";

  explicit ImpulseLaw(const ContactParameters& parameters)
      : friction_{parameters.friction, parameters.slip_length, parameters.shear_limit} {}

  void fit(const TerrainParameters&, const std::string&) const {}
  void update_stiffness(const ParticleGroup&, std::size_t, ContactHistory&) const {}
  Vector3 force(const ContactMotion& contact, double dt, ContactHistory& history,
                ContactLosses& losses) const;

 private:
  /// share of the penetration that one step removes [Baumgarte1972]
  static constexpr double correction = 0.2;

  Friction friction_;
};

inline Vector3 ImpulseLaw::force(const ContactMotion& contact, double dt, ContactHistory& history,
                                 ContactLosses& losses) const {
  const Vector3& n = contact.point.normal;
  const double approach = -contact.velocity.dot(n);
  const double normal_force =
      std::max(0.0, contact.mass * (approach - correction * contact.point.gap / dt) / dt);
  const Vector3 sliding = contact.velocity + approach * n;
  history.slip += contact.last_dt * sliding.norm();
  const double limit = friction_.limit(normal_force, history.slip, contact.area);
  const double stopping = contact.mass * sliding.norm() / dt;
  const double size = std::min(limit, stopping);
  losses.damping += normal_force * approach * dt;
  losses.friction += size * sliding.norm() * dt;
  return normal_force * n - (stopping > 0.0 ? contact.mass / dt * size / stopping : 0.0) * sliding;
}

}  // namespace furrow
