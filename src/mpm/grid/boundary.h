// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Boundary conditions at the six faces of the grid.

#include <array>
#include <string>
#include <vector>

#include "furrow/core/checkpoint.h"
#include "furrow/core/communicator.h"
#include "furrow/core/types.h"
#include "furrow/mpm/grid/face.h"
#include "furrow/mpm/grid/grid.h"

namespace furrow {

/// free: no traction; smooth: no velocity across the face (a plane of symmetry too); rough: no
/// velocity; absorbing: the rest of the half-space, see Boundary.
enum class BoundaryKind { free, smooth, rough, absorbing };
const std::vector<std::string>& boundary_kind_names();  ///< in the order of BoundaryKind
BoundaryKind boundary_kind(const std::string& name);    ///< @throws Error for an unknown name

/// Elastic wave speeds of the undisturbed ground at one height.
struct WaveSpeeds {
  double pressure;  ///< c_p [m/s]
  double shear;     ///< c_s [m/s]
};

/// Boundary conditions of the ground at the faces of its grid.
///
/// Absorbing faces stand for the far field [Lysmer1969], as infinite elements do in [Shoop2001]
/// (theory: continuum, eq. 8): traction
///   t = t_0 - rho c v - (rho c^2/L) u
/// with c = c_p across the face and c_s along it, t_0 the traction that held the ground at the
/// start, u the displacement since then, and L the distance over which the far field yields: from
/// the middle of the ground, or a plane of symmetry, to the face. With a node's mass m and the
/// extent l of its B-spline across the face, rho A = m/l. The dashpot is implicit; the spring uses
/// the u of the start of the step. Each velocity field has a separate far field.
///
/// When the grid moves along x by a cell, values of the far field stay with the ground, and faces
/// across x come to ground that they have not held yet:
///   ahead   it is undisturbed: t_0 stays; the displacement of the far field falls off over L, so
///           that u becomes u exp(-h/L) in a cell of length h
///   behind  it is deformed for good and carries another stress: t_0 becomes what holds it beside
///           the dashpot, t_0 = t + rho c v with t the traction that leaves the node at its
///           velocity, and u = 0
///
/// `local` nodes are those that this rank's particles reach; sums (impulse, work) count the `owned`
/// nodes only, so that their sum over the ranks counts each node once.
class Boundary {
 public:
  /// @param particles_per_cell  in each direction, of the undisturbed ground
  /// @param speeds_of_level     one for each plane of nodes across z, from below
  Boundary(const Grid& grid, const FaceArray<BoundaryKind>& kinds,
           const std::array<int, 3>& particles_per_cell, std::vector<WaveSpeeds> speeds_of_level);

  BoundaryKind kind(Face face) const { return kinds_[face]; }
  /// True if a smooth or rough face fixes a component of a node's velocity.
  bool is_fixed(const Grid& grid, const std::array<int, 3>& node, int component) const;

  /// False until an absorbing face knows t_0.
  bool has_initial_tractions() const { return has_initial_tractions_; }
  /// Takes t_0 from the node sums (forces of the initial stress) and gravity [m/s^2] before the
  /// first step; the sums and masses of the absorbing nodes are set to zero.
  void capture_initial_tractions(Grid& grid, const NodeBlock& local, const Vector3& gravity);

  /// After a move of the grid, lets the face behind take t_0 from node sums and gravity [m/s^2].
  void renew_tractions(Grid& grid, const NodeBlock& local, const Vector3& gravity);

  /// Changes the velocities of the face nodes over a step dt [s].
  void apply(Grid& grid, const NodeBlock& local, const NodeBlock& owned, double dt);

  /// Forces of the faces on a node that is kept at rest. The far field keeps its displacement.
  /// @param mass, force  of all particles at the node; gravity is in the force [kg], [N]
  /// @param reactions  get the forces of the faces [N]
  /// @return the force that no face balances [N]
  Vector3 hold(const Grid& grid, const std::array<int, 3>& node, double mass, Vector3 force,
               FaceArray<Vector3>& reactions) const;
  /// Adds to the impulses what the faces gave to nodes that apply() does not see [N s].
  void add_impulses(const FaceArray<Vector3>& forces, double dt);

  /// Impulse that a face gave to the ground since the start, this rank's share [N s].
  const Vector3& impulse(Face face) const { return impulse_[face]; }
  /// Work of the absorbing faces on the ground since the start, this rank's share [J].
  double work() const { return work_; }

  /// The grid moved by whole cells along x.
  void shift_x(int cells);
  /// Every rank takes the far field of the ranks that own the nodes. Collective.
  void synchronise(const Communicator& ranks, const NodeBlock& owned);
  /// Replaces impulses and work by those of all ranks. Collective.
  void sum_over_ranks(const Communicator& ranks);
  /// @param keep_sums on one rank only: impulses and work of all ranks are then counted once
  void checkpoint(Checkpoint& state, bool keep_sums);

 private:
  /// An absorbing face; three numbers for each node, the nodes in the order of for_face().
  struct FarField {
    int axis = 0;
    int plane = 0;                      // of nodes, along the axis
    int nodes[2] = {0, 0};              // along the face: slow, fast
    double inverse_extent = 0.0;        // 1/l [1/m]
    double inverse_length = 0.0;        // 1/L [1/m]
    double decay = 0.0;                 // exp(-h/L) of the outermost cell
    std::vector<double> initial_force;  // t_0 A [N]
    std::vector<double> displacement;   // u [m]
  };
  using FarFields = FaceArray<FarField>;
  double speed_of(const FarField& far, const std::array<int, 3>& node, int component) const;
  static double held_acceleration(const FarField& far, std::size_t n, double speed, double mass);
  void release(const Grid& grid, FarFields& far_fields, Face holder,
               const std::array<int, 3>& node) const;
  FarFields far_fields(const Grid& grid, const std::array<int, 3>& particles_per_cell) const;
  void constrain(Grid& grid, Face face, const NodeBlock& local, const NodeBlock& owned);
  void absorb(Grid& grid, int field, Face face, const NodeBlock& local, const NodeBlock& owned,
              double dt);
  template <class Visit>
  void for_far_fields(Visit visit);

  FaceArray<BoundaryKind> kinds_;
  std::vector<WaveSpeeds> speeds_;
  std::vector<FarFields> far_;  // of each velocity field; empty vectors unless the face absorbs
  FaceArray<Vector3> impulse_;
  double work_ = 0.0;
  bool has_initial_tractions_ = true;
  bool renewal_due_ = false;  // true while the traction of the ground at the face behind is unknown
};

}  // namespace furrow
