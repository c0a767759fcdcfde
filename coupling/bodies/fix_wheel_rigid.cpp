// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/bodies/fix_wheel_rigid.h"

#include "coupling/base/args.h"

namespace furrow::coupling {

FixWheelRigid::FixWheelRigid(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixWheelRigid(lammps, narg, arg, schema().read(args_after_style(narg, arg))) {}

FixWheelRigid::FixWheelRigid(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg,
                             const Options& options)
    : FixWheelHub(lammps, narg, arg, std::make_unique<RigidWheel>(options), options) {}

}  // namespace furrow::coupling
