// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix contact/continuum: contact between a body and continuum terrain. See
/// fix_contact_continuum.md.

#include "coupling/contact/fix_contact.h"
#include "mpm/contact/terrain_contact.h"

namespace furrow::coupling {

class FixTerrainContinuum;

class FixContactContinuum : public FixContact {
 public:
  FixContactContinuum(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();
  static const Outputs<FixContactContinuum>& outputs();

  const TerrainContact& contact() const { return contact_; }
  FixTerrainContinuum& terrain_fix() const { return terrain_fix_; }

 private:
  FixTerrainContinuum& find_terrain();
  void checkpoint(Checkpoint& state) override { contact_.checkpoint(state); }
  /// A half body's outputs are those of the whole.
  double halves() { return body().half_model() ? 2.0 : 1.0; }

  FixTerrainContinuum& terrain_fix_;
  TerrainContact contact_;
};

}  // namespace furrow::coupling
