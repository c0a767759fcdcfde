// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A simulation box whose edges stretch, as fix deform of LIGGGHTS with `remap v` has it. Only fix
/// deform is meant to set these members of Domain: there may be no other while one of these moves.

#include <array>

#include "lammps.h"

namespace furrow::coupling {

class BoxMotion {
 public:
  /// @param group_bit of the grains that gain velocity when they cross a face
  BoxMotion(LAMMPS_NS::LAMMPS& lammps, int group_bit) : lammps_(lammps), group_bit_(group_bit) {}
  ~BoxMotion();  ///< the box stands
  BoxMotion(const BoxMotion&) = delete;
  BoxMotion& operator=(const BoxMotion&) = delete;

  /// Announces the motion in Fix::init(), before every run: grains and ghosts that cross a face
  /// gain the velocity of the opposite face. @param rates stretching of the edges now, compression
  /// positive [1/s]
  void announce(const std::array<double, 3>& rates);
  /// Edges after dt [s] of stretching at these rates about the middle of the box.
  void advance(const std::array<double, 3>& rates, double dt);

 private:
  LAMMPS_NS::LAMMPS& lammps_;
  int group_bit_;
};

/// Velocity along z of the moving box at height z [m/s].
double box_velocity_z(const LAMMPS_NS::LAMMPS& lammps, double z);

}  // namespace furrow::coupling
