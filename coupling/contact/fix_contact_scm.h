// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix contact/scm: contact between a body and a height field by the soil contact model. See
/// fix_contact_scm.md.

#include "coupling/contact/fix_field_contact.h"
#include "furrow/scm/scm_contact.h"

namespace furrow::coupling {

class FixContactScm : public FixFieldContact {
 public:
  FixContactScm(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();
  static const Outputs<FixContactScm>& outputs();

  const ScmContact& contact() const { return contact_; }
  void add_losses(const Body& wheel, GroundLosses& losses) const override;
  std::vector<std::pair<std::string, std::string>> settings() const override;
  void init() override {
    collectively([&] { check_stability(); });
  }

 private:
  const SoilPatches& soils() const;
  ScmContact::Settings settings_of_contact();
  double contact_width() const;
  void check_stability();
  void checkpoint(Checkpoint& state) override { contact_.checkpoint(state); }

  const ScmContact::Settings settings_;
  ScmContact contact_;
};

}  // namespace furrow::coupling
