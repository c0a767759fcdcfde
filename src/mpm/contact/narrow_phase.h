// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Narrow phase of a contact: whether a particle touches a surface, where, and by how much.

#include "furrow/bodies/body.h"
#include "furrow/geometry/triangle_search.h"
#include "furrow/mpm/contact/contact_search.h"
#include "furrow/mpm/contact/particle_contact.h"
#include "furrow/mpm/particles/particles.h"

namespace furrow {

/// A particle represents ground that reaches half a spacing beyond it (theory: contact, eqs. 1
/// and 2):
///   gap = distance to the surface - reach,   reach = (1 + e) J |(n_1 h_1, n_2 h_2, n_3 h_3)|,
/// with n the normal, h_a the half spacings and J the volume ratio of the particle. e is 0 until
/// the particle first touches. While it touches, the gap follows the relative motion of ground and
/// surface at the point of contact, over a step with the mean of n before and after, and e adapts.
/// The spring of a contact then returns the work that it takes, also when n or J changes under
/// load.
///
/// Hysteresis: the contact switches to another part of the surface only if that is closer by a
/// tenth of half the spacing; otherwise it would alternate between the equally near edges of two
/// ribs. At a switch half of the change is measured with the motion of the part that was left, on
/// which the force acted: two walls that a particle presses apart gain no energy.
///
/// The error of the gap is a fraction of the spacing. A gap never exceeds the distance, e >= -1:
/// ground whose middle is inside a surface stays in contact.
class NarrowPhase {
 public:
  /// The body must outlive the narrow phase.
  explicit NarrowPhase(const Body& body);

  /// A particle farther from the surface than this does not touch it [m].
  static double largest_reach(const Particles& particles, std::size_t particle,
                              const ContactHistory& history) {
    return (1.0 + history.reach_excess) * particles.volume_ratio(particle) *
           particles.half_spacing(particle).maxCoeff();
  }

  /// Finds the point of the surface nearest to a particle; its gap if it did not touch in the last
  /// step.
  /// @param position  of the candidate's particle now [m]
  ContactPoint find(const ContactSearch& search, const ContactSearch::Candidate& candidate,
                    const Particles& particles, const Vector3& position,
                    const ContactHistory& history) const;
  /// Value of x or v at the point of the surface where the particle touched in the last step.
  Vector3 point_of(const Matrix3X& nodal, const ContactHistory& history) const;
  /// Sets the gap of a particle that touched in the last step, and e of its history.
  /// @param velocity  v_ground - v_surface [m/s]
  /// @param velocity_there  the same now where the particle touched in the last step [m/s]
  /// @param dt  since the last step [s]
  static void follow(const Vector3& velocity, const Vector3& velocity_there, double dt,
                     const Particles& particles, std::size_t particle, ContactHistory& history,
                     ContactPoint& contact);

 private:
  /// Reach of a particle with e = 0 [m].
  static double reach(const Particles& particles, std::size_t particle, const Vector3& normal) {
    return particles.volume_ratio(particle) *
           normal.cwiseProduct(particles.half_spacing(particle)).norm();
  }

  const Body& body_;
  NodeTriangles node_triangles_;
};

}  // namespace furrow
