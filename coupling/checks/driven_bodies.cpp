// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/checks/driven_bodies.h"

#include "coupling/liggghts/fixes_of.h"
#include "coupling/bodies/fix_plate_rigid.h"
#include "coupling/bodies/fix_wheel_hub.h"
#include "coupling/drive/fix_wheel_rig.h"

namespace furrow::coupling {

std::vector<DrivenBody> driven_bodies(const LAMMPS_NS::Modify& modify) {
  std::vector<DrivenBody> driven;
  for (auto* rig : fixes_of<FixWheelRig>(modify))
    driven.push_back({rig->wheel_fix(), rig->options(), rig->rig().cruise_start(),
                      "start, settle_time and accelerate_time"});
  for (auto* plate : fixes_of<FixPlateRigid>(modify))
    driven.push_back({*plate, plate->options(), plate->full_speed(), "start and accelerate_time"});
  return driven;
}

}  // namespace furrow::coupling
