// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/checks/driven_bodies.h"

#include "coupling/base/fixes_of.h"
#include "coupling/bodies/fix_plate_rigid.h"
#include "coupling/bodies/fix_wheel_hub.h"
#include "coupling/drive/fix_wheel_rig.h"

namespace furrow::coupling {

std::vector<DrivenBody> driven_bodies(const LAMMPS_NS::Modify& modify) {
  std::vector<DrivenBody> driven;
  for (auto* rig : fixes_of<FixWheelRig>(modify))
    driven.push_back({rig->wheel_fix(), rig->options()});
  for (auto* plate : fixes_of<FixPlateRigid>(modify)) driven.push_back({*plate, plate->options()});
  return driven;
}

}  // namespace furrow::coupling
