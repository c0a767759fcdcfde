// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/wheels/fix_wheel_rigid.h"

#include "coupling/liggghts/styles/style_registry.h"

namespace furrow::coupling {

const StyleRow wheel_rigid_style =
    fix_style<FixWheelRigid>("wheel/rigid", "wheel", "wheels/fix_wheel_rigid.md");

FixWheelRigid::FixWheelRigid(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixWheelHub(lammps, narg, arg, schema(),
                  [](const Options& options) { return std::make_unique<RigidWheel>(options); }) {}

}  // namespace furrow::coupling
