// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Active ground: leaves out of the steps what is at rest, and counts what that neglects.
///
/// The ground is cut into tiles of some cells along x and y, over the full depth. Particles of a
/// sleeping tile keep place and stress and lose their velocity. Nodes that they reach are held: the
/// awake ground ends there as at a rough face. Decisions are made between two intervals of steps,
/// and weighed over a period of some intervals:
///
///   neglected force   sum over the tiles of |mean of the force that holds their nodes|
///   neglected energy  kinetic energy of the tiles that fall asleep, since the start
///
/// The force that holds a tile's nodes balances the stresses of tile and awake ground, gravity and
/// the loads of the grid's faces. It is zero in equilibrium.
///
/// The tolerance tau allows a share of the mean force F of the contacts and of their work W since
/// the start. A tile falls asleep under three conditions.
///   - No body is near.
///   - It hardly moves. Its mean displacement u in a period would stretch it by a force
///     m c^2 u/L^2 of at most tau F/10. Here m is its mass, c the wave speed and L its edge.
///   - It loses little energy. Tiles that fall asleep together lose at most tau times the mean
///     work of a period. The neglected energy therefore stays below tau W.
/// A tile wakes when a body comes near. When the neglected force exceeds tau F, the tiles with the
/// largest shares wake. A tile that woke without a body waits for twice as many periods each time.
/// All tiles wake when gravity changes, as while a rig tilts it onto a slope.
///
/// The neglected force bounds the error of a contact force, by Betti's theorem. Press a body by d
/// into linearly elastic ground at rest. Free nodes would move by u_i. Held by forces f_i, they
/// change the force on the body by sum f_i u_i/d, and |u_i| <= d.

#include <array>
#include <vector>

#include "furrow/core/checkpoint.h"
#include "furrow/mpm/grid/boundary.h"
#include "furrow/mpm/grid/discretisation.h"
#include "furrow/mpm/terrain_energy.h"
#include "furrow/mpm/transfer/transfer.h"

namespace furrow {

/// Switches off ground at rest, tile by tile; for ground without window and slide surface. Tiles
/// are the same on all ranks.
class ActiveGround {
 public:
  /// Force and energy that sleeping ground neglects.
  struct Neglect {
    double force = 0.0;          ///< mean over the last period [N]
    double largest_force = 0.0;  ///< of all periods [N]
    double energy = 0.0;         ///< since the start [J]
  };

  /// All parts must outlive this. From then on sorting records the columns of particles.
  /// @param tolerance  tau > 0; @param gravity  [m/s^2]
  ActiveGround(double tolerance, const Vector3& gravity, Discretisation& discretisation,
               Boundary& boundary, const TerrainEnergy& energy);

  const Neglect& neglect() const { return neglect_; }
  double awake_share() const;  ///< of the particles; collective
  /// Fastest wave in sleeping ground of this rank [m/s].
  double resting_wave_speed() const { return resting_wave_speed_; }
  bool asleep(double x, double y) const;  ///< of the ground at x, y [m]

  /// Keeps the ground in and around a box awake, until the next decision. To be called on all
  /// ranks. [m]
  void keep_awake(const Vector3& lower, const Vector3& upper);
  /// Sets gravity from the next step on [m/s^2]. To be called on all ranks.
  void set_gravity(const Vector3& gravity) {
    gravity_changed_ |= gravity != gravity_;
    gravity_ = gravity;
  }

  // ---- parts of a step
  /// The forces of this rank's contacts in a step [N].
  void count_load(const Vector3& force, double dt) { load_impulse_ += dt * force; }
  /// Stops the nodes of the border, once nodes have mass and velocity.
  void stop_border();
  /// Counts the forces on the border, which the nodes do not follow.
  void hold_border(double dt);
  /// Adds the motion of the tiles at the end of an interval, before the displacements of the nodes
  /// are cleared.
  void add_motion();

  // ---- between two intervals; collective
  /// Decides which tiles awake or fall asleep. @return whether any does: particles must be sorted
  bool decide();
  /// Finds particles and nodes of the tiles again after particles were sorted.
  void rebuild();

  void checkpoint(Checkpoint& state);
  /// Continues a run after particles and nodes are restored.
  void resume();

 private:
  /// Motion of a tile in an interval: of the nodes of this rank, then of all ranks.
  struct Motion {
    double kinetic = 0.0;                    // at the end [J]
    Vector3 moved = Vector3::Zero();         // sum of mass times displacement [kg m]
    Vector3 held_impulse = Vector3::Zero();  // of the force that holds its nodes [N s]
    static constexpr std::size_t numbers = 7;
  };
  struct Tile {
    bool asleep = false;
    bool near_body = false;
    int wait = 0;                     // periods until it may fall asleep
    int last_wait = 0;                // of the last time that it woke without a body
    double largest_kinetic = 0.0;     // in this period [J]
    Vector3 moved = Vector3::Zero();  // sum of mass times displacement in this period [kg m]
    Vector3 held_impulse =
        Vector3::Zero();  // impulse of the force on held nodes in this period [N s]
  };
  struct HeldNode {
    std::array<int, 3> node;
    std::size_t tile;
    double resting_mass;                 // of sleeping particles [kg]
    Vector3 resting_force;               // of their stress [N]
    Vector3 momentum = Vector3::Zero();  // momentum from awake particles [N s]
  };

  int tile_of_cell(int axis, int cell) const;
  std::size_t tile_of_node(int i, int j) const;
  CellRange cells_of(int axis, int tile) const;
  std::size_t number(int a, int b) const { return static_cast<std::size_t>(a * count_[1] + b); }
  template <class Visit>
  void for_tiles(Visit&& visit);
  template <class Visit>
  void for_particles(const ParticleGroup& group, bool asleep, Visit&& visit) const;
  template <class Visit>
  void for_own_columns(Visit&& visit) const;
  char state_of(int i, int j) const {
    return node_state_[static_cast<std::size_t>(i * discretisation_.grid.nodes(1) + j)];
  }

  double force_limit() const;
  double held_force() const;
  void sum_over_ranks();
  bool wake_near_bodies();
  bool wake_for_gravity();
  bool wake_for_force();
  bool fall_asleep();
  void wake(Tile& tile, bool for_a_body);
  void begin_period();

  void find_awake_particles();
  void bring_to_rest();
  void find_nodes();
  std::size_t sleeping_tile_at(int i, int j) const;
  template <class Pass>
  std::vector<NodeBlock> find_blocks(Pass pass) const;
  void find_resting_sums();
  std::vector<double> count_in_columns(const ParticleGroup& group) const;

  double tolerance_;
  Vector3 gravity_;               // [m/s^2]
  bool gravity_changed_ = false;  // since the last decision
  Discretisation& discretisation_;
  Boundary& boundary_;
  const TerrainEnergy& energy_;
  std::array<int, 2> count_;  // of tiles along x and y
  std::vector<Tile> tiles_;
  std::vector<HeldNode> held_;           // of this rank
  std::vector<char> node_state_;         // of each column of nodes, y running fastest
  FaceArray<Vector3> resting_reaction_;  // of the faces on sleeping nodes off the border [N]
  double resting_wave_speed_ = 0.0;      // [m/s]
  std::vector<std::vector<double>> saved_counts_;  // of particles in columns, until resume()

  // sums of this rank since the last decision
  std::vector<Motion> motion_;  // of the tiles
  Vector3 load_impulse_ = Vector3::Zero();
  double lost_energy_ = 0.0;
  // sums and times of all ranks
  int steps_ = 0;                              // in this period
  double elapsed_ = 0.0;                       // in this period [s]
  double interval_ = 0.0;                      // since the last decision [s]
  Vector3 contact_impulse_ = Vector3::Zero();  // since the first contact [N s]
  double contact_time_ = 0.0;                  // [s]
  double contact_work_ = 0.0;                  // [J]
  Neglect neglect_;
};

}  // namespace furrow
