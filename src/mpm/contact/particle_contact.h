// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// One particle in contact with a surface: the point of contact, the motion there, the history.

#include <cstddef>
#include <type_traits>

#include "furrow/core/types.h"

namespace furrow {

/// Point where a particle touches a surface.
struct ContactPoint {
  std::size_t triangle;  ///< of the surface
  Vector3 barycentric;   ///< of the closest point, in the triangle
  Vector3 position;      ///< closest point of the surface [m]
  Vector3 normal;        ///< out of the surface, of unit length
  double gap;            ///< < 0: penetration [m]
  double distance;       ///< of the particle from the surface, along the normal [m]
  /// the particle touched another facet in the last step (NarrowPhase)
  bool switches_facet = false;
};

/// Motion of a touching particle, for a contact law.
struct ContactMotion {
  const ContactPoint& point;
  Vector3 velocity;  ///< of the ground relative to the surface, at the point [m/s]
  double mass;       ///< of the particle [kg]
  double area;       ///< of the surface that the particle stands for [m^2]
  double last_dt;    ///< length of the step that ended with this velocity [s]
};

/// Energy that a contact takes [J].
struct ContactLosses {
  double friction = 0.0;
  double damping = 0.0;
};

/// History of a contact: what a particle keeps from one step to the next. The contact adds a
/// column of histories to the particles (ParticleColumn); a record is a row of doubles.
struct ContactHistory {
  /// True if the particle touched in the last step.
  bool touches() const { return gap < 0.0; }
  /// True if the particle has slipped and does not touch, but is no farther than its reach.
  bool bounces() const { return !touches() && slip > 0.0; }
  /// True if the particle has not touched, or has left the surface.
  static bool is_idle(const double* record) {
    const auto& history = *reinterpret_cast<const ContactHistory*>(record);
    return !history.touches() && !history.bounces();
  }
  /// The particle begins to bounce, or goes on.
  /// @param path  along the surface in the last step [m]
  void lift(double path) {
    spring.setZero();
    gap = 0.0;
    slip += path;
  }
  /// The particle has left the surface.
  void end_contact() {
    lift(0.0);
    slip = 0.0;
  }

  Vector3 spring = Vector3::Zero();  ///< stretch of the tangential spring [m]
  double slip = 0.0;                 ///< path along the surface since the first touch [m]
  double stiffness = 0.0;            ///< of the springs in the last step [N/m]
  double gap = 0.0;                  ///< in the last step [m]; 0: the particle did not touch
  double reach_excess = 0.0;         ///< e of NarrowPhase
  // Contact point of the last step, if the particle touched: normal, and place on the surface.
  Vector3 normal = Vector3::Zero();
  double triangle = 0.0;
  Vector3 barycentric = Vector3::Zero();
};

/// Numbers of a history in a record of the particles.
constexpr int contact_history_numbers = 14;
static_assert(sizeof(ContactHistory) == contact_history_numbers * sizeof(double) &&
                  std::is_standard_layout_v<ContactHistory>,
              "a history is a row of doubles");

}  // namespace furrow
