// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Forces and torques of the grains, kept in a restart file.
///
/// LIGGGHTS computes contact forces with velocities at mid-step, but after a restart it knows those
/// of the full step only: the first forces of a continued run would differ by what damping makes of
/// half a step. So a checkpoint in the middle of a run brings them.

#include "lammps.h"

namespace furrow::coupling {

class GrainForces {
 public:
  explicit GrainForces(LAMMPS_NS::LAMMPS& lammps) : lammps_(lammps) {}

  /// Makes the storage, a fix property/atom; LIGGGHTS then writes, reads and moves it with the
  /// grains.
  void make_storage();
  void store();     ///< call while a restart file is being written
  void put_back();  ///< call before the first step of a continued run

 private:
  LAMMPS_NS::LAMMPS& lammps_;
};

}  // namespace furrow::coupling
