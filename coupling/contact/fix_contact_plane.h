// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix contact/plane: a body on a rigid level floor, without grains. See fix_contact_plane.md.

#include <memory>

#include "bodies/rigid_plane.h"
#include "coupling/base/uses_fix.h"
#include "coupling/output/effective_input.h"
#include "fix.h"

namespace furrow::coupling {

class FixContactPlane : public LAMMPS_NS::Fix, public HasOptions, public UsesFix {
 public:
  FixContactPlane(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  ~FixContactPlane() override;
  static Schema schema();

  const Options& options() const override { return options_; }
  bool uses(LAMMPS_NS::Fix& other) const override { return &other == body_fix_; }

  int setmask() override { return 0; }
  void post_create() override;
  void pre_delete(bool unfixflag) override;
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;
  /// f_id[1-3]: force on the body [N], f_id[4]: largest pressure at a node [Pa], f_id[5]: area of
  /// the touching nodes [m^2]
  double compute_vector(int n) override;

 private:
  struct PlaneContact;
  Options options_;
  LAMMPS_NS::Fix* body_fix_;
  std::unique_ptr<PlaneContact> contact_;
};

}  // namespace furrow::coupling
