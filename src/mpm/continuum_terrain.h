// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Deformable terrain as a continuum, of any material of the library, under any surface that
/// presses on it. The material point method moves it by explicit steps: particles carry the
/// material and its stress, a grid their motion. terrain_step.h explains the method.

#include <optional>
#include <string>
#include <vector>

#include "furrow/bodies/body.h"
#include "furrow/core/communicator.h"
#include "furrow/mpm/active_ground.h"
#include "furrow/mpm/grid/boundary.h"
#include "furrow/mpm/grid/discretisation.h"
#include "furrow/mpm/discontinuities/divided_ground.h"
#include "furrow/mpm/free_surface_mesh.h"
#include "furrow/mpm/ground/moving_window.h"
#include "furrow/mpm/multirate.h"
#include "furrow/mpm/particles/particle_distribution.h"
#include "furrow/mpm/particles/particle_refinement.h"
#include "furrow/mpm/transfer/point_loads.h"
#include "furrow/mpm/transfer/remap_control.h"
#include "furrow/mpm/terrain_energy.h"
#include "furrow/mpm/ground/terrain_fill.h"
#include "furrow/mpm/ground/terrain_parameters.h"
#include "furrow/mpm/terrain_step.h"

namespace furrow {

/// The body that a scene sees, composed of one part for each job:
///   TerrainFill           undisturbed particles, at the start and ahead of a moving window
///   Discretisation        grid, particles, and the partition of both over the ranks
///   ParticleDistribution  particles in the order of their cells, on the ranks of their cells
///   Boundary              conditions at the faces of the grid
///   SlideContact          friction between two pieces of ground
///   TerrainStep           one step; RemapControl: when particles and grid are remapped
///   PointLoads            forces at points and the motion there: contact
///   ActiveGround          ground at rest that is not computed
///   DividedGround         ground on both sides of thin parts
///   MovingWindow          ground that moves along with a body, and the rut behind it
///   ParticleRefinement    particles of this window that suit their cells
///   FreeSurfaceMesh       triangles for grains that lie on the terrain
///   Multirate             one step of the terrain for several of these grains
///   TerrainEnergy         energies and works
///
/// Every rank computes a block of the terrain; bodies that touch it are replicated. Calls are
/// collective unless said otherwise.
class ContinuumTerrain : public Body {
 public:
  /// @param where  names the terrain in errors
  /// @throws InputError for parameters that do not go together, or a material that cannot carry the
  /// weight
  ContinuumTerrain(const TerrainParameters& parameters, const Communicator& ranks,
                   const std::string& where = "continuum ground");
  ContinuumTerrain(const ContinuumTerrain&) = delete;  // parts refer to one another
  ContinuumTerrain& operator=(const ContinuumTerrain&) = delete;

  double stable_time_step() const override;
  void advance(double dt) override;
  using Body::surface;
  /// The triangles of a free surface mesh, if there is one; a contact presses on the particles.
  Surface& surface() override { return free_surface_.surface(); }
  EnergyBudget energy_budget() const override;
  /// Work of contacts since the start, by its use.
  TerrainWork work() const { return energy_.work(boundary_.work(), ranks()); }
  /// Saves the number of particles and nodes; their values go to keep_values_in().
  void checkpoint(Checkpoint& state) override;
  /// Sets where each rank keeps its particles and nodes, before checkpoint(); not owned.
  void keep_values_in(RankNumbers& numbers) { rank_numbers_ = &numbers; }
  /// Size of particles and nodes in a checkpoint, of all ranks [bytes].
  double checkpoint_size() const;

  // Functions that are not collective.
  /// [m/s^2] from the next step on, in the place of that of the parameters.
  void set_gravity(const Vector3& gravity) {
    step_.set_gravity(gravity);
    if (active_) active_->set_gravity(gravity);
  }
  const TerrainParameters& parameters() const { return parameters_; }
  const Grid& grid() const { return discretisation_.grid; }
  const Communicator& ranks() const { return discretisation_.ranks(); }
  const Partition& partition() const { return discretisation_.partition; }

  /// Impulse that a face of the grid gave to the ground since the start [N s].
  Vector3 boundary_impulse(Face face) const;
  /// Heat from friction on the slide surface since the start [J].
  double slide_loss() const;
  double particle_count() const;  ///< of all ranks
  /// Traffic of a rank for the sums at shared nodes since the start, mean of the ranks.
  HaloTraffic halo_traffic() const { return discretisation_.exchange.mean_traffic(ranks()); }

  // ---- this rank's particles; not collective ----------------------------------------------------

  /// Up to date with the grid. Stresses that are changed here act from the next remap on.
  std::vector<ParticleGroup>& groups();
  /// Groups whose positions and velocities may be those of the start of the remap interval; the
  /// rest is of now.
  std::vector<ParticleGroup>& unsynchronised_groups() { return discretisation_.groups; }
  /// Bound of the distance by which the positions of unsynchronised_groups() lag [m].
  double staleness() const { return remap_.staleness(); }
  /// Positions and motions of particles now.
  void interpolate_motion(const std::vector<ParticleIndex>& particles,
                          std::vector<ParticleMotion>& motions);
  /// Changes whenever particles change their order.
  unsigned long generation() const { return distribution_.generation(); }
  /// Largest speed at the start of the remap interval, or seen at loaded points since [m/s].
  double largest_speed() const { return remap_.largest_speed(); }
  /// Applies a force [N] to the ground at a point [m] during the next step. The weights of a
  /// particle nearby spread it over the nodes.
  /// @param work  gets its work in that step [J]; must live until then, and may be null
  void add_point_force(const ParticleIndex& near, const Vector3& force, const Vector3& point,
                       double* work = nullptr);

  // ---- active ground; not collective ------------------------------------------------------------

  /// Keeps the ground around a surface awake; to be called before each step.
  void keep_awake_near(const Surface& surface);
  /// Active ground; null where all of the ground is computed.
  const ActiveGround* active() const { return active_ ? &*active_ : nullptr; }

  // ---- thin parts; not collective
  // ----------------------------------------------------------------

  /// Thin parts of a body divide the ground in the next step, if parameters().thin_parts; to be
  /// called before each step. Surface and parts must live until then.
  void divide_by(const Surface& surface, const std::vector<ThinPart>& parts) {
    if (divided_) divided_->divide_by(surface, parts);
  }

  // ---- moving window; not collective ------------------------------------------------------------

  /// The middle of the terrain follows this x [m], by whole cells, slabs or strides, from the next
  /// remap on.
  void follow(double x) { window_.follow(x); }
  const RutRecord& rut() const { return window_.rut(); }
  double travelled() const { return window_.travelled(); }  ///< of the grid since the start [m]
  std::size_t dropped_slabs() const { return window_.dropped_slabs(); }  ///< since the start

 private:
  void fill(const std::string& where);
  double stable_step_now() const;
  void step(double dt, const Matrix3X& surface_forces);
  void place_surface_mesh();
  void sort_particles();
  void checkpoint_boundary(Checkpoint& state);
  static void match_layer(const TerrainLayer& layer, Checkpoint& state);
  void resume();

  TerrainParameters parameters_;
  Discretisation discretisation_;
  TerrainFill fill_;
  Boundary boundary_;
  TerrainEnergy energy_;
  ParticleDistribution distribution_;
  RemapControl remap_;
  PointLoads loads_;
  std::optional<SlideContact> slide_;
  std::optional<ActiveGround> active_;
  std::optional<DividedGround> divided_;
  std::optional<ParticleRefinement> refinement_;
  TerrainStep step_;
  MovingWindow window_;
  FreeSurfaceMesh free_surface_;
  Multirate multirate_;
  RankNumbers* rank_numbers_ = nullptr;
};

}  // namespace furrow
