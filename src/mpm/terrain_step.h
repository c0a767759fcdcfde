// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// One step of a terrain: explicit material point method on quadratic B-splines, with affine
/// transfers (APIC), stress updated last, and a grid reset every few steps. Why the grid is kept,
/// and the equations: theory: continuum, eqs. 1 to 6.
///
/// A remap interval lies between two grid resets and has m steps. The step functions are called in
/// this order; transfer.h has the transfers.
///
///   begin_remap_interval  Chooses m by the speed of the particles (remap_control.h) and places the
///                         quadrature points at x_s = x_p + (m - 1)/2 dt v_p.
///   particles_to_grid     Gives the nodes mass and velocity, and sets their displacement u_i to
///                         zero. It splits off the residual motion r, w of the particles, and
///                         starts f_i with the force of the stress.
///   sum_nodal_forces      Adds contact forces to f_i and sums over the ranks, in each step.
///   accelerate_nodes      Adds dt (f_i/m_i + g) to v_i and applies slide surface and boundaries.
///   move_nodes            Adds dt v_i to u_i.
///   update_particles      Strains the material by H = dt sum v_i G_i^T, averaged over cells
///                         (cell_average.h), and computes f_i of the new stress.
///   grid_to_particles     Ends the last step. It adds sum N_i u_i to x_p, and computes v_p and C_p
///                         from v_i and r, w.
///
/// Velocities are those of half steps (leapfrog, as in LIGGGHTS); all is in double precision.
///
/// All N_i and G_i of an interval are those at the quadrature position x_s, the mean of the
/// positions x_p + k dt v_p of its steps k = 0 ... m - 1. The strain then has an error of second
/// order in the motion during the interval. Because the weights stay, they are computed once a
/// step: the force of the new stress uses those of the strain. With m = 1, x_s = x_p.
///
/// The residual motion is what the splines do not show of the particles' motion. Without it each
/// reset smooths the velocity over a cell, about twenty times while the ground moves by a cell at
/// any speed: an error of first order in the cell [Fei2021].
///
/// Momentum is conserved exactly; angular momentum exactly for m = 1, else to second order in the
/// rotation during an interval.

#include <array>
#include <vector>

#include "furrow/mpm/active_ground.h"
#include "furrow/mpm/grid/boundary.h"
#include "furrow/mpm/grid/discretisation.h"
#include "furrow/mpm/discontinuities/divided_ground.h"
#include "furrow/mpm/particles/particle_distribution.h"
#include "furrow/mpm/transfer/point_loads.h"
#include "furrow/mpm/transfer/remap_control.h"
#include "furrow/mpm/discontinuities/slide_contact.h"
#include "furrow/mpm/terrain_energy.h"
#include "furrow/mpm/ground/terrain_parameters.h"
#include "furrow/mpm/transfer/transfer.h"

namespace furrow {

/// Every call is collective unless said otherwise.
class TerrainStep {
 public:
  /// The other parts must outlive the step.
  /// @param gravity  [m/s^2]; @param slide  null: the ground is of one piece
  /// @param active  null: all of the ground is computed; @param divided  null: no thin parts
  TerrainStep(Discretisation& discretisation, Boundary& boundary,
              ParticleDistribution& distribution, RemapControl& remap, PointLoads& loads,
              TerrainEnergy& energy, const Vector3& gravity, const TransferScheme& scheme,
              const SlideContact* slide, ActiveGround* active, DividedGround* divided);

  /// Advances from t_n to t_n + dt [s]. Afterwards particles are up to date only if
  /// remap.interval_running() is false. @throws StateError when a particle leaves the grid or a
  /// material refuses its strain
  void advance(double dt);

  /// Sets gravity [m/s^2] from the next step on. Not collective.
  void set_gravity(const Vector3& gravity) { gravity_ = gravity; }

  /// Positions and motion of the particles from the grid, if they lag behind it. Not collective.
  void grid_to_particles();
  /// Lets absorbing faces take the tractions of the initial stress, before the first step.
  void capture_initial_tractions();
  /// Restores the forces of the stress, which are not saved, after a restart in an interval. Not
  /// collective.
  void restore_stress_forces();

 private:
  // ---- phases of advance(), in its order
  void begin_remap_interval(double dt);
  void sum_nodal_forces();
  void complete_sums();
  void accelerate_nodes(double dt);
  void move_nodes(double dt);
  void update_particles(double dt);
  void count_energies(double dt);
  void end_step(double dt);

  // ---- parts of them
  void set_quadrature_positions(double time);
  void particles_to_grid();
  void scatter_stress_forces();
  void clear_sums();
  void clear_displacement();
  void update_particles(ParticleGroup& group, std::size_t first, std::size_t count,
                        const GridView& grid, double dt);
  template <class Visit>
  void for_chunks(ParticleGroup& group, Visit&& visit);
  void scatter_force(const GridView& grid, ParticleView particles);
  void allocate(std::size_t particles);
  void update_stress(ParticleGroup& group, std::size_t first, std::size_t count, double dt);

  Discretisation& discretisation_;
  Boundary& boundary_;
  ParticleDistribution& distribution_;
  RemapControl& remap_;
  PointLoads& loads_;
  TerrainEnergy& energy_;
  Vector3 gravity_;  // [m/s^2]
  TransferScheme scheme_;
  const SlideContact* slide_;
  ActiveGround* active_;
  DividedGround* divided_;
  const TransferKernels& kernels_;
  NodeTotals node_totals_;  // of this rank's nodes after they have moved

  // Buffers of a chunk of particles.
  std::vector<double> gradient_storage_;
  std::array<double*, 9> gradient_;  // H row by row
  std::vector<double> normal_stress_storage_;
  std::array<double*, 3> normal_stress_;  // with the mean pressure of the cell [Pa]
  std::vector<Weights> weights_;
  std::vector<double*> state_pointers_;
};

}  // namespace furrow
