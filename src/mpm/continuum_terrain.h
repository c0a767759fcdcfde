// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Continuum ground by the explicit material point method, for any law of the material library and
/// any surface that presses on it.

#include <memory>
#include <vector>

#include "bodies/body.h"
#include "core/communicator.h"
#include "mpm/terrain_parameters.h"
#include "mpm/free_surface_mesh.h"
#include "mpm/overburden.h"
#include "mpm/particles.h"
#include "mpm/partition.h"

namespace furrow {

/// All particles of one law.
struct ParticleGroup {
  std::shared_ptr<const Material> material;
  Particles particles;
};

struct ParticleIndex {
  std::size_t group, particle;
};

/// Of a particle: the field of velocity around it is velocity + affine (x - reference).
struct ParticleMotion {
  Vector3 position, reference, velocity;  ///< [m], [m], [m/s]
  Matrix3 affine;                         ///< [1/s]
  Vector3 velocity_at(const Vector3& x) const { return velocity + affine * (x - reference); }
};

/// What is left behind of a moving ground: the surface where it was dropped.
struct RutPoint {
  double x, y;     ///< [m]
  double z;        ///< of the surface [m]
  double density;  ///< mean over the depth [kg/m^3]
};

/// One step from t_n to t_n+1 (double precision throughout; velocities at half steps, as LIGGGHTS's
/// leapfrog has them):
///   forces of stress and contact -> grid, faces, nodes move, strain -> particles (transfer.h), the
///   law with H.
///
/// The grid moves with the ground for a cycle of m steps; then its velocity and displacement go to
/// the particles and theirs to a fresh grid. Each such mapping smooths the velocity and takes
/// kinetic energy (EnergyBudget::numerical_loss): with one at each step, 15 % of the work of a
/// wheel on snow in 4 cm cells; with one in 16 steps, a third of that. In a cycle the weights are
/// taken at the place that a particle passes half-way, x_ref = x + (m - 1)/2 dt v, so that strain
/// is that of the mid-configuration, and they are found once a step: the law's new stress gives its
/// force to the grid with the weights of the strain. Momentum is kept exactly, angular momentum
/// exactly for m = 1 and else to second order in the turn of a cycle. m: at most
/// TerrainParameters::remap_interval, and no more steps than any particle needs for a twentieth of
/// a cell, compacted as the particle is. Between, particles lag behind: phases() brings them up to
/// date. What phases() changes of stresses is seen from the next cycle on.
///
/// Particles are kept in the order of their cells. Each rank owns a slab of the ground
/// (partition.h); every call is collective unless said otherwise, and bodies that touch it are
/// replicated.
class ContinuumTerrain : public Body {
 public:
  /// @param where names the ground in errors  @throws InputError
  ContinuumTerrain(const TerrainParameters& parameters, const Communicator& ranks,
                   const std::string& where = "continuum ground");

  double stable_time_step() const override;
  void advance(double dt) override;
  using Body::surface;
  /// The sheet of a ground that carries grains; otherwise without triangles, as others press on the
  /// particles.
  Surface& surface() override { return free_surface_.surface(); }
  EnergyBudget energy_budget() const override;
  void checkpoint(Checkpoint& state) override;

  const TerrainParameters& parameters() const { return parameters_; }
  const Grid& grid() const { return grid_; }
  const Boundary& boundary() const { return boundary_; }
  const Communicator& ranks() const { return partition_.ranks(); }
  /// [N s] given to the ground since the start
  Vector3 face_impulse(Face face) const;
  double particle_count() const;  ///< of all ranks
  /// of this rank's particles in the last step
  const UpdateReport& last_report() const { return report_; }

  // ---- this rank's particles; not collective ----------------------------------------------------
  std::vector<ParticleGroup>& groups();
  /// The same with places and velocities that may be those of the start of the cycle; the rest is
  /// of now.
  std::vector<ParticleGroup>& unsynchronised_groups() { return groups_; }
  /// by which places are behind at most [m]
  double staleness() const { return unsynchronised_ ? travel_ : 0.0; }
  /// Where particles are and how they move.
  void probe(const std::vector<ParticleIndex>& points, std::vector<ParticleMotion>& motions);
  /// Changes whenever particles change their places in memory.
  unsigned long generation() const { return generation_; }
  /// [m/s] of this rank's particles, at the start of the cycle or pushed since.
  double largest_speed() const { return largest_speed_; }
  /// A force on the ground during the next step [N], by the weights of a particle near the point
  /// where it acts [m].
  void add_point_force(const ParticleIndex& near, const Vector3& force, const Vector3& point);

  // ---- moving ground ----------------------------------------------------------------------------
  /// The middle of the ground follows this x, cell by cell: ground is dropped behind and fresh
  /// ground added ahead.
  void follow(double x) { focus_ = x; }
  /// this rank's share of what was dropped
  const std::vector<RutPoint>& rut() const { return rut_; }
  double travelled() const;  ///< [m] of the grid since the start

 private:
  struct PointLoad {
    ParticleIndex near;
    Vector3 force, point;
  };
  void fill();
  void make_free_surface();
  void update_free_surface();
  void add_column(int cell);
  bool remap_pending() const { return steps_left_ > 0; }
  void begin_remap_interval(double dt);
  void set_shape_positions(double time);
  void remap();
  void update_particles();
  void particles_to_grid();
  void scatter_stress_forces();
  void scatter_contact_forces();
  void update_stress(double dt);
  void count_contact_work(double dt);
  Vector3 particle_momentum() const;
  void move_window();
  void remove_behind();
  void sort();
  void migrate();
  // of a field per reference volume, this rank's particles [J]
  double energy(std::size_t kind) const;
  double internal_energy() const;
  GridView local_view();
  [[noreturn]] void report_outside(const ParticleGroup& group) const;
  void checkpoint_totals(Checkpoint& state);
  void checkpoint_rut(Checkpoint& state);
  void checkpoint_particles(Checkpoint& state);
  void resume();

  TerrainParameters parameters_;
  std::string where_;
  Grid grid_;
  std::vector<ParticleLevel> levels_;
  std::vector<ParticleGroup> groups_;
  Partition partition_;
  Boundary boundary_;
  const TransferKernels& kernels_;

  std::vector<PointLoad> point_loads_;
  std::vector<PointForce> point_forces_;
  std::vector<PointMotion> point_motions_;
  std::vector<ParticleIndex> pushed_;
  std::vector<ParticleMotion> pushed_motions_;
  std::vector<double> gradient_;
  std::vector<Weights> weights_;
  std::vector<double*> state_pointers_;
  UpdateReport report_;
  unsigned long generation_ = 0;
  double largest_speed_ = 0.0, drift_ = 0.0,
         travel_ = 0.0;  // [m/s]; [m] possible since the last sorting, since the cycle began
  int steps_left_ = 0;   // of the cycle
  bool unsynchronised_ = false;  // particles are behind the grid
  NodeTotals totals_;            // of this rank's nodes after the last step
  double next_id_ = 0.0;
  double focus_, start_;  // [m]
  int shifts_ = 0;        // of the window, in cells
  std::vector<RutPoint> rut_;
  FreeSurfaceMesh free_surface_;

  // this rank's share, since the start [J]
  double initial_ = 0.0, stress_work_ = 0.0, contact_work_ = 0.0, gravity_work_ = 0.0;
  double dropped_kinetic_ = 0.0, dropped_internal_ = 0.0, dropped_dissipated_ = 0.0;
};

}  // namespace furrow
