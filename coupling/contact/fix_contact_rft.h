// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix contact/rft: contact between a rigid body and sand by resistive force theory. See
/// fix_contact_rft.md.

#include "coupling/contact/fix_field_contact.h"
#include "furrow/scm/rft_contact.h"

namespace furrow::coupling {

class FixContactRft : public FixFieldContact {
 public:
  FixContactRft(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();
  static const Outputs<FixContactRft>& outputs();

  const RftContact& contact() const { return contact_; }
  /// Stresses act on the triangles of the body.
  bool needs_fine_cells() const override { return false; }
  void add_losses(const Body& wheel, GroundLosses& losses) const override;

 private:
  Body& rigid_body() const;
  RftContact::Settings settings_of_contact() const;
  void checkpoint(Checkpoint& state) override { contact_.checkpoint(state); }

  RftContact contact_;
};

}  // namespace furrow::coupling
