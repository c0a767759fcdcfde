// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A surface that presses on a continuum terrain: wheel, tyre or plate against the particles
/// (theory: contact).

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "furrow/bodies/body.h"
#include "furrow/bodies/contact.h"
#include "furrow/geometry/thin_parts.h"
#include "furrow/mpm/contact/contact_law.h"
#include "furrow/mpm/contact/contact_parameters.h"
#include "furrow/mpm/contact/contact_search.h"
#include "furrow/mpm/contact/narrow_phase.h"
#include "furrow/mpm/contact/symmetry_mirror.h"
#include "furrow/mpm/continuum_terrain.h"

namespace furrow {

/// Composition of ContactSearch (which particles are near), NarrowPhase (which of them touch, and
/// where), ContactLaw (with what force) and, in a half model, SymmetryMirror.
///
/// The force of a particle acts at the closest point of the surface. The surface takes it by
/// barycentric weights, the ground as a point load through the particle's weights. Force and moment
/// are therefore equal on both sides. Each rank finds the contacts of its particles; the forces on
/// the surface are summed over the ranks.
class TerrainContact : public Contact {
 public:
  /// Body and terrain must outlive the contact. Not collective.
  /// @param half_model  the terrain's lower y face is a plane of symmetry and the surface is whole:
  ///                    it takes the mirrored forces as well
  /// @param where       names the contact in errors, and its values in checkpoints of the terrain
  /// @throws InputError when a half model's surface is not its own mirror image, or the law cannot
  /// work on this terrain
  TerrainContact(Body& body, ContinuumTerrain& terrain, const ContactParameters& parameters,
                 bool half_model, const std::string& where);

  /// Collective. @throws StateError when the body is beyond the terrain, inside it at the start, or
  /// too deep in it
  void apply(double dt) override;

  // Results of the last step, of all ranks and, in a half model, of both halves; not collective.
  const Vector3& force() const { return force_; }           ///< on the body [N]
  double contacts() const { return step_.contacts; }        ///< particles that touch
  double area() const { return step_.area; }                ///< of the surface in contact [m^2]
  double penetration() const { return step_.penetration; }  ///< the deepest [m]
  // Results since the start.
  double deepest_penetration() const { return deepest_penetration_; }  ///< [m]
  double friction_loss() const { return losses_.friction; }            ///< [J]
  double damping_loss() const { return losses_.damping; }              ///< [J]
  /// Work of this contact on the computed terrain, in a half model on the half [J]. Collective.
  double terrain_work() const { return terrain_.ranks().sum(terrain_work_); }

  /// Sums since the start, length and outputs of the last step. The histories are part of the
  /// terrain's checkpoint. Restored after body and terrain. Collective.
  void checkpoint(Checkpoint& state);

 private:
  /// Sums over the particles that touch in a step.
  struct StepTotals {
    double contacts = 0.0;
    double area = 0.0;         // [m^2]
    double penetration = 0.0;  // largest [m]
    ContactLosses losses;
  };
  const ParticleGroup& group_of(const ParticleIndex& particle) const {
    return terrain_.unsynchronised_groups()[particle.group];
  }
  ContactHistory& history_of(const ParticleIndex& particle);
  void search();
  void select_active();
  /// Contact in a cell of the ground. Some of its particles bounce in each step, because they press
  /// unequally. The others carry their share of the surface too.
  struct CellContact {
    double slip = 0.0;        // mean of the touching particles [m]
    double area_share = 1.0;  // surface of touching and bouncing particles over that of the first
  };
  CellContact contact_in_cell(std::size_t n, std::size_t& end);
  template <class Law>
  void add_forces(const Law& law, double dt);
  ContactPoint find_contact(std::size_t n, ContactHistory& history, Vector3& velocity);
  void add_force(const ParticleIndex& particle, const ContactPoint& contact, const Vector3& force,
                 const Vector3& velocity, double dt);
  void sum_over_ranks();
  void add_other_half();
  void record_step();

  Body& body_;
  ContinuumTerrain& terrain_;
  ContactLaw law_;
  ContactSearch search_;
  NarrowPhase narrow_phase_;
  std::optional<SymmetryMirror> mirror_;
  std::vector<ThinPart> thin_parts_;             // of the body, where they divide the ground
  std::vector<ParticleColumn> history_columns_;  // of each particle group

  // Candidates that may touch now, and their motions.
  std::vector<std::size_t> active_;
  std::vector<ParticleIndex> active_particles_;
  std::vector<ParticleMotion> motions_;

  Matrix3X nodal_forces_;  // on the body [N]
  StepTotals step_;
  Vector3 force_ = Vector3::Zero();
  ContactLosses losses_;       // since the start
  double terrain_work_ = 0.0;  // since the start, this rank's share [J]
  double deepest_penetration_ = 0.0;
  double last_dt_ = 0.0;  // length of the last step [s]
  bool begun_ = false;    // surface and ground were apart at the start
};

}  // namespace furrow
