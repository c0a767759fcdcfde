// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix wheel/arc: stress and slip along the arc in which a wheel touches the ground. See
/// fix_wheel_arc.md.

#include <vector>

#include "coupling/base/roles/fix_order.h"
#include "coupling/base/furrow_fix.h"
#include "furrow/rig/contact_arc.h"

namespace furrow::coupling {

class FixWheelHub;

class FixWheelArc : public FurrowFix, public SystemFollower {
 public:
  FixWheelArc(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  ~FixWheelArc() override;
  static Schema schema();
  static OutputTable outputs();

  std::string reason_to_follow() const override {
    return "it takes the grains' contacts of the whole step";
  }
  int setmask() override { return LAMMPS_NS::FixConst::END_OF_STEP; }
  void init() override;
  void end_of_step() override;

 private:
  void add_grains();
  void write_profile();
  void checkpoint(Checkpoint& state) override;

  FixWheelHub& wheel_fix_;
  ContactArc arc_;
  long every_;
  double duration_ = 0.0;                     // [s] in the sums
  std::vector<std::vector<double>> columns_;  // of the file; rank 0 only
};

}  // namespace furrow::coupling
