// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix layer/shear: a layer of grains frozen into a rough rigid plate that shears a periodic cell.
/// See fix_layer_shear.md.

#include <array>

#include "coupling/output/effective_input.h"
#include "fix.h"

namespace furrow::coupling {

class FixLayerShear : public LAMMPS_NS::Fix, public HasOptions {
 public:
  FixLayerShear(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();

  int setmask() override;
  void init() override;
  void initial_integrate(int vflag) override;
  void final_integrate() override;
  /// f_id[1]: displacement along x [m]; f_id[2..4]: force of the other grains on the layer [N]
  double compute_vector(int n) override;
  const Options& options() const override { return options_; }

 private:
  Options options_;
  double speed_, accelerate_time_;
  double elapsed_ = 0.0, displacement_ = 0.0, height_ = 0.0;
  std::array<double, 3> force_{};
};

}  // namespace furrow::coupling
