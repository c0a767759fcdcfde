// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Splits the work of a body on grains by where it goes.

#include <array>
#include <vector>

#include "furrow/core/types.h"

namespace LAMMPS_NS {
class Atom;
}

namespace furrow::coupling {

/// Work that a body gives = press + push + friction + contact [J].
struct ContactWork {
  double press = 0.0;     ///< on the grains by vertical forces, down less up
  double push = 0.0;      ///< on the grains by horizontal forces and by torques
  double friction = 0.0;  ///< along the surface: lost by sliding, stored by tangential springs
  double contact = 0.0;   ///< normal to the surface, and by rolling friction

  static constexpr std::size_t size = 4;
  std::array<double, size> numbers() const { return {press, push, friction, contact}; }
  static ContactWork from(const double* n) { return {n[0], n[1], n[2], n[3]}; }
  ContactWork& operator+=(const ContactWork& other);
};

/// Contact of a grain with a body in one step.
struct GrainContact {
  int grain;              ///< local index
  Vector3 force, torque;  ///< on the grain [N], [N m]
  Vector3 normal;         ///< unit vector normal to the surface
  Vector3 point;          ///< of the surface, where the body is [m]
  Vector3 arm;            ///< from the grain's centre to where the contact model lets force act [m]
  Vector3 surface_velocity;  ///< at this place [m/s]
};

/// Work of contacts in one step, with the velocities of grains at its end. Force times the velocity
/// between two steps of the leapfrog is its exact work: a spring gives back what it takes.
ContactWork work_of(const std::vector<GrainContact>& contacts, const LAMMPS_NS::Atom& atom,
                    double dt);

}  // namespace furrow::coupling
