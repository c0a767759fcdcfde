// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix contact/continuum: contact between a body and continuum terrain. See
/// fix_contact_continuum.md.

#include "coupling/base/roles/fix_terrain.h"
#include "coupling/contact/fix_ground_contact.h"
#include "furrow/mpm/contact/terrain_contact.h"

namespace furrow::coupling {

class FixContactContinuum : public FixContactWith<FixTerrain> {
 public:
  FixContactContinuum(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();
  static const Outputs<FixContactContinuum>& outputs();

  const TerrainContact& contact() const { return contact_; }
  void add_losses(const Body& wheel, GroundLosses& losses) const override;
  std::vector<std::pair<std::string, std::string>> settings() const override;

 private:
  ContactParameters parameters();
  void check_terrain() const;
  // [J] since the start, of the whole body
  double friction_loss() const { return symmetry_factor() * contact_.friction_loss(); }
  double damping_loss() const { return symmetry_factor() * contact_.damping_loss(); }
  void checkpoint(Checkpoint& state) override { contact_.checkpoint(state); }

  const ContactParameters parameters_;
  TerrainContact contact_;
};

}  // namespace furrow::coupling
