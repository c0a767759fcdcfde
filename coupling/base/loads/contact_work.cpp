// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/base/loads/contact_work.h"

#include "atom.h"

namespace furrow::coupling {

ContactWork& ContactWork::operator+=(const ContactWork& other) {
  press += other.press;
  push += other.push;
  friction += other.friction;
  contact += other.contact;
  return *this;
}

ContactWork work_of(const std::vector<GrainContact>& contacts, const LAMMPS_NS::Atom& atom,
                    double dt) {
  ContactWork work;
  for (const GrainContact& each : contacts) {
    const Vector3 velocity = Eigen::Map<const Vector3>(atom.v[each.grain]);
    const Vector3 spin = Eigen::Map<const Vector3>(atom.omega[each.grain]);
    const Vector3 along = each.force - each.force.dot(each.normal) * each.normal;
    const Vector3 sliding = velocity + spin.cross(each.arm) - each.surface_velocity;
    const double given = each.force.dot(each.surface_velocity) * dt;
    const double press = each.force.z() * velocity.z() * dt;
    const double push = (each.force.head<2>().dot(velocity.head<2>()) + each.torque.dot(spin)) * dt;
    const double friction = -along.dot(sliding) * dt;
    work += {press, push, friction, given - press - push - friction};
  }
  return work;
}

}  // namespace furrow::coupling
