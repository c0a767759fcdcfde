// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix terrain/continuum: ground by the material point method. See fix_terrain_continuum.md.

#include "coupling/base/uses_fix.h"
#include "coupling/output/effective_input.h"
#include "coupling/bodies/fix_body.h"
#include "mpm/continuum_terrain.h"

namespace furrow::coupling {

class FixTerrainContinuum : public FixBody,
                            public MotionController,
                            public HasOptions,
                            public UsesFix {
 public:
  FixTerrainContinuum(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();

  ContinuumTerrain& ground() { return static_cast<ContinuumTerrain&>(body()); }
  bool half_model() const { return options_.flag("symmetry"); }
  const Options& options() const override { return options_; }
  bool uses(LAMMPS_NS::Fix& other) const override;

  int setmask() override;
  void post_create() override;
  void pre_delete(bool unfixflag) override;
  void end_of_step() override;
  void apply(double time, double dt) override;
  double compute_vector(int n) override;

 private:
  FixTerrainContinuum(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, const Options& options);
  void report() const;
  void check_energy();

  Options options_;
  LAMMPS_NS::Fix* followed_fix_ = nullptr;
  Body* followed_ = nullptr;
};

}  // namespace furrow::coupling
