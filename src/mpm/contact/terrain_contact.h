// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A surface that presses on continuum ground: wheel, tyre or plate against the particles.

#include <limits>
#include <memory>
#include <vector>

#include "bodies/contact.h"
#include "geometry/triangle_search.h"
#include "core/options.h"
#include "mpm/continuum_terrain.h"

namespace furrow {

struct ContactParameters {
  enum class Enforcement {
    penalty,  ///< springs normal and along, with damping
    /// approach and penetration are taken away within the step, as far as the particle's own mass
    /// does it
    impulse
  };
  Enforcement enforcement = Enforcement::penalty;
  double friction = 0.3;  ///< mu of Coulomb's law; 0: smooth, infinity: rough
  /// k of TR eq 26 [m]: tau = mu sigma (1 - exp(-j/k)), j the slip; 0: Coulomb's law
  double slip_length = 0.0;
  /// spring of a particle over (wave modulus) x (cube root of its volume)
  double stiffness = 0.4;
  double damping = 0.1;  ///< of the spring with the particle's mass, of critical
};

/// A particle stands for ground that reaches half a spacing beyond it; what matters is the half
/// spacing along the contact normal, which shrinks with the volume of the particle because ground
/// under a wheel is compressed that way:
///   gap = distance to the surface - J sum_a |n_a| h_a.
/// Its error is a fraction of the spacing and vanishes with it. The force acts at the closest point
/// of the surface on both sides: on the surface by barycentric weights, on the ground by
/// PointImpulse, so that force and moment are kept.
///
/// Half models: with a ground that ends in a symmetry plane y = y_lower, the surface is whole and
/// takes the mirrored forces as well.
class TerrainContact : public Contact {
 public:
  /// The keys of a contact. @param subject names the owner in errors
  static Schema schema(const std::string& subject = "contact with ground");
  static ContactParameters parameters_from(const Options& options);

  /// Body and ground must outlive the contact. @param half_model the ground's lower y face is a
  /// plane of symmetry
  /// @throws InputError when a half model's surface is not its own mirror image
  TerrainContact(Body& body, ContinuumTerrain& ground, const ContactParameters& parameters,
                 bool half_model, const std::string& where);

  void apply(double dt) override;

  // What the last step had; of all ranks and, of a half model, both halves.
  const Vector3& force() const { return force_; }  ///< on the body [N]
  double contacts() const { return contacts_; }
  double penetration() const { return penetration_; }      ///< the deepest [m]
  double deepest_penetration() const { return deepest_; }  ///< since the start [m]
  double friction_loss() const { return friction_loss_; }  ///< since the start [J]
  double damping_loss() const { return damping_loss_; }    ///< since the start [J]
  /// of the touching particles' faces [m^2]
  double area() const { return area_; }

  /// Sums since the start, and when the candidates were found; what particles carry of a contact is
  /// part of the ground's state. Its length depends on the surface only.
  void checkpoint(Checkpoint& state);  ///< restored after body and terrain

 private:
  struct Near {
    double distance;  // when the candidates were found [m]
    int triangle;
  };
  struct Candidate {
    ParticleIndex at;
    Vector3 found;            // where the particle was when the candidates were found
    std::size_t first, last;  // its triangles in near_, the nearest first
  };
  struct Touch {
    Vector3 point, normal, barycentric;
    double gap;
    std::size_t triangle;
  };
  bool is_stale();
  void search();
  void find_candidates(bool stiffness_anew);
  void refuse_overlap() const;
  void refuse_departure() const;
  double* memory_of(const ParticleIndex& at);
  void forget(const ParticleIndex& at);
  double touch_distance(const ParticleIndex& at) const;
  void choose_active();
  bool touch(const Candidate& candidate, const Vector3& x, Touch& touch) const;
  Vector3 penalty_force(const Touch& touch, const Vector3& velocity, double mass, double stiffness,
                        double dt, double* memory);
  Vector3 impulse_force(const Touch& touch, const Vector3& velocity, double mass, double dt,
                        double* memory);
  double friction_limit(double normal_force, double slip) const;
  void collect();

  Body& body_;
  ContinuumTerrain& ground_;
  ContactParameters parameters_;
  std::string where_;
  NodeTriangles corners_;
  // the node at the mirror image of each node; empty unless half a model
  std::vector<int> mirror_;
  std::vector<std::size_t> memory_;  // column of each phase: see Memory in the source

  std::vector<Candidate> candidates_;
  std::vector<Near> near_;
  std::vector<std::size_t> active_;    // candidates that may have come close enough by now
  std::vector<ParticleIndex> points_;  // their particles
  std::vector<ParticleMotion> motions_;
  Matrix3X searched_;  // nodes when the candidates were found
  unsigned long generation_ = 0;
  // [m] of the last search; staleness_: by which its places were behind
  double reach_ = 0.0, skin_ = 0.0, staleness_ = 0.0;
  // [m] of the surface and of the ground since the last search
  double moved_ = 0.0, drift_ = 0.0;
  bool started_ = false;

  Matrix3X nodal_;  // forces on the body [N]
  std::vector<double> buffer_;
  Vector3 force_ = Vector3::Zero();
  double contacts_ = 0.0, penetration_ = 0.0, area_ = 0.0, deepest_ = 0.0, friction_loss_ = 0.0,
         damping_loss_ = 0.0;
  double step_friction_ = 0.0, step_damping_ = 0.0;
};

}  // namespace furrow
