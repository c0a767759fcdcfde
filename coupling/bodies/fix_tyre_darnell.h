// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix tyre/darnell: an inflated tyre on a rigid rim. See fix_tyre_darnell.md.

#include "coupling/bodies/fix_wheel_hub.h"
#include "tyre/darnell_tyre.h"

namespace furrow::coupling {

class FixTyreDarnell : public FixWheelHub {
 public:
  FixTyreDarnell(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();
  static const Outputs<FixTyreDarnell>& outputs();

  DarnellTyre& tyre() { return static_cast<DarnellTyre&>(body()); }
  void init() override;

 protected:
  void checkpoint(Checkpoint& state) override;
};

}  // namespace furrow::coupling
