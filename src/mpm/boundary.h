// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What the ground is held by at the six faces of its grid.

#include <array>
#include <string>
#include <vector>

#include "core/checkpoint.h"
#include "core/communicator.h"
#include "core/types.h"
#include "mpm/grid.h"

namespace furrow {

/// free: nothing; smooth: no velocity across (a symmetry plane too); rough: no velocity;
/// absorbing: the rest of the half-space, see Boundary.
enum class BoundaryKind { free, smooth, rough, absorbing };
enum Face { x_lower, x_upper, y_lower, y_upper, z_lower, z_upper };
constexpr int face_count = 6;
const std::vector<std::string>& boundary_kind_names();  ///< in the order of BoundaryKind
BoundaryKind boundary_kind(const std::string& name);    ///< @throws Error

/// Elastic wave speeds [m/s] of the undisturbed ground at a height.
struct WaveSpeeds {
  double pressure, shear;
};

/// Absorbing faces stand for the far field as infinite elements do (J. Lysmer, R. L. Kuhlemeyer, J.
/// Eng. Mech. 95, 1969; TR uses ABAQUS's): traction t = t_0 - rho c v - (rho c^2/L) u with c = c_p
/// across the face and c_s along it, t_0 what held the ground at the start, u the displacement
/// since, L the distance over which the far field gives way. The dashpot is quiet for plane waves,
/// the spring holds statically. With a node's mass m and the extent l of its B-spline across the
/// face, rho A = m/l. Taken implicitly.
class Boundary {
 public:
  Boundary(const Grid& grid, const std::array<BoundaryKind, face_count>& kinds,
           const std::array<int, 3>& particles_per_cell, std::vector<WaveSpeeds> speeds_of_level);

  BoundaryKind kind(Face face) const { return kinds_[face]; }
  /// Before anything else happens to the grid of the first step: its sums of momenta, and gravity
  /// [m/s^2], are what the held ground must stand, and are used up.
  bool captured() const { return captured_; }
  void capture(Grid& grid, const PlaneRange& planes, const Vector3& gravity);
  /// Changes the velocities of nodes. Sums count the planes of `owned` only.
  void apply(Grid& grid, const PlaneRange& planes, const PlaneRange& owned, double dt);

  /// Impulse that each face gave to the ground since the start, this rank's share [N s].
  const Vector3& impulse(Face face) const { return impulse_[face]; }
  /// of absorbing faces on the ground since the start, this rank's share [J]
  double work() const { return work_; }

  void shift_x(int cells);  ///< the grid moved: face nodes keep their place in space
  /// Every rank takes the displacements of the rank that owns a plane.
  void synchronise(const Communicator& ranks, const PlaneRange& owned);
  void collect(const Communicator& ranks);  ///< impulses and work become those of all ranks
  /// @param keep_sums on one rank only: restored impulses and work are then counted once
  void checkpoint(Checkpoint& state, bool keep_sums);

 private:
  struct FarField {
    int axis = 0, plane = 0, count[2] = {0, 0};  // nodes of the face: count[0] slow, count[1] fast
    double inverse_extent = 0.0, inverse_length = 0.0;
    std::vector<double> hold, displacement;  // three numbers a node [N], [m]
  };
  void constrain(Grid& grid, Face face, const PlaneRange& planes, const PlaneRange& owned);
  void absorb(Grid& grid, Face face, const PlaneRange& planes, const PlaneRange& owned, double dt);
  bool is_held(const Grid& grid, const std::array<int, 3>& at, int component) const;

  std::array<BoundaryKind, face_count> kinds_;
  std::vector<WaveSpeeds> speeds_;
  std::array<FarField, face_count> far_;
  std::array<Vector3, face_count> impulse_;
  double work_ = 0.0;
  bool captured_ = false;
};

}  // namespace furrow
