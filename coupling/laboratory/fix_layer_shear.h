// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix layer/shear: a layer of grains frozen into a rough rigid plate that shears a periodic cell.
/// See fix_layer_shear.md.

#include <array>

#include "coupling/base/furrow_fix.h"
#include "furrow/rig/ramp.h"

namespace furrow::coupling {

class FixLayerShear : public FurrowFix {
 public:
  FixLayerShear(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();
  static const Outputs<FixLayerShear>& outputs();

  int setmask() override;
  void init() override;
  void initial_integrate(int vflag) override;
  void final_integrate() override;

 private:
  /// True, so that the rules of the scene (coupling/checks) apply.
  bool needs_system() const override { return true; }
  void checkpoint(Checkpoint& state) override;
  double middle_of_layer() const;  // z [m]
  void check_speed() const;

  double speed_;  // [m/s] along x
  Ramp ramp_;
  double elapsed_ = 0.0;           // [s]
  double displacement_ = 0.0;      // [m] along x
  double height_ = 0.0;            // [m] z of the middle of the layer
  bool height_restored_ = false;   // from a checkpoint, until the first run has begun
  std::array<double, 3> force_{};  // [N] of the other grains on the layer
};

}  // namespace furrow::coupling
