// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix contact/bodies: contact between a body and continuum ground. See fix_contact_continuum.md.

#include <memory>

#include "coupling/base/uses_fix.h"
#include "coupling/output/effective_input.h"
#include "fix.h"
#include "mpm/contact/terrain_contact.h"

namespace furrow::coupling {

class FixTerrainContinuum;

class FixContactBodies : public LAMMPS_NS::Fix, public HasOptions, public UsesFix {
 public:
  FixContactBodies(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();

  const TerrainContact& contact() const { return *contact_; }
  const Options& options() const override { return options_; }
  bool uses(LAMMPS_NS::Fix& other) const override {
    return &other == body_fix_ || &other == terrain_fix_;
  }

  int setmask() override { return 0; }
  void post_create() override;
  void pre_delete(bool unfixflag) override;
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;
  double compute_vector(int n) override;

 private:
  Options options_;
  LAMMPS_NS::Fix *body_fix_, *terrain_fix_;
  std::unique_ptr<TerrainContact> contact_;
  bool half_body_ = false;
};

}  // namespace furrow::coupling
