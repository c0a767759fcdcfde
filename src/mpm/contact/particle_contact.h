// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// One particle in contact with a surface: where it touches, how it moves, what it remembers.

#include <cstddef>

#include "core/types.h"

namespace furrow {

/// Where a particle touches a surface.
struct ContactPoint {
  std::size_t triangle;  ///< of the surface
  Vector3 barycentric;   ///< of the closest point, in the triangle
  Vector3 position;      ///< closest point of the surface [m]
  Vector3 normal;        ///< out of the surface, of unit length
  double gap;            ///< < 0: penetration [m]
  double distance;       ///< of the particle from the surface, along the normal [m]
  /// the particle has left for it the place where it touched in the last step (NarrowPhase)
  bool leaps = false;
};

/// What a contact law knows of a touching particle.
struct ContactMotion {
  const ContactPoint& point;
  Vector3 velocity;  ///< of the ground relative to the surface, at the point [m/s]
  double mass;       ///< of the particle [kg]
};

/// Energy that a contact takes [J].
struct ContactLosses {
  double friction = 0.0;
  double damping = 0.0;
};

/// What a particle remembers of a contact: a view of its numbers in the column that the contact
/// added to the particles, so that they follow it through sorting, migration and checkpoints.
struct ContactHistory {
  static constexpr int size = 14;  ///< numbers of a particle

  explicit ContactHistory(double* numbers)
      : spring(numbers),
        slip(numbers[3]),
        stiffness(numbers[4]),
        gap(numbers[5]),
        reach_excess(numbers[6]),
        normal(numbers + 7),
        triangle(numbers[10]),
        barycentric(numbers + 11) {}

  /// Whether it touched in the last step.
  bool touches() const { return gap < 0.0; }
  /// The particle touches no more.
  void end_contact() {
    spring.setZero();
    slip = 0.0;
    gap = 0.0;
  }

  Eigen::Map<Vector3> spring;  ///< stretch of the tangential spring [m]
  double& slip;                ///< path along the surface since the contact began [m]
  double& stiffness;           ///< of the springs, as of the last search [N/m]
  double& gap;                 ///< in the last step [m]; 0: it did not touch
  double& reach_excess;        ///< of the particle: e of NarrowPhase
  // Of the last step, if it touched: the normal, and the point of the surface
  Eigen::Map<Vector3> normal;
  double& triangle;
  Eigen::Map<Vector3> barycentric;
};

}  // namespace furrow
