// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Whether a particle touches a surface, where, and by how much: the narrow phase of a contact.

#include "bodies/body.h"
#include "geometry/triangle_search.h"
#include "mpm/contact/contact_search.h"
#include "mpm/contact/particle_contact.h"
#include "mpm/particles.h"

namespace furrow {

/// A particle stands for ground that reaches half a spacing beyond it. What counts is the half
/// spacing along the contact normal, which shrinks with the volume of the particle because ground
/// under a wheel is compressed that way:
///   gap = distance to the surface - J sum_a |n_a| h_a.
/// The error is a fraction of the spacing and vanishes with it.
class NarrowPhase {
 public:
  /// The body must outlive the narrow phase.
  explicit NarrowPhase(const Body& body);

  /// A particle farther from the surface than this does not touch it [m].
  static double reach(const Particles& particles, std::size_t particle) {
    return particles.volume_ratio(particle) * particles.half_spacing(particle).norm();
  }

  /// @param position  of the candidate's particle now [m]
  /// @param contact   set when it touches
  bool find(const ContactSearch& search, const ContactSearch::Candidate& candidate,
            const Particles& particles, const Vector3& position, ContactPoint& contact) const;

 private:
  const Body& body_;
  NodeTriangles node_triangles_;
};

}  // namespace furrow
