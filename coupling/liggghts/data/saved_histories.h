// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Contact histories of grains, with one another and with walls, as a checkpoint brought them.
///
/// The set-up of a run computes forces without a step. Some models of LIGGGHTS (tan_luding, rolling
/// friction luding) then add an increment to their histories all the same: a continued run would
/// have one more than the run without a break.

#include <map>
#include <vector>

#include "lammps.h"

namespace furrow::coupling {

class SavedHistories {
 public:
  /// Saves the histories between the making of neighbour lists and the first forces.
  void save(LAMMPS_NS::LAMMPS& lammps);
  /// Restores the histories after the set-up; contacts that were not there at save() stay as they
  /// are.
  void put_back(LAMMPS_NS::LAMMPS& lammps);

 private:
  using Values = std::vector<double>;
  using OfGrain = std::map<int, Values>;  // by triangle

  Values pairs_;                              // of all neighbours
  std::vector<Values> walls_;                 // of each plane or cylinder, all grains
  std::vector<std::vector<OfGrain>> meshes_;  // of each mesh, each grain
};

}  // namespace furrow::coupling
