// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix plate/mesh: a rigid tool from a mesh file that moves at a prescribed velocity. See
/// fix_plate_mesh.md.

#include "coupling/wheels/fix_plate_rigid.h"

namespace furrow::coupling {

class FixPlateMesh : public FixPlateRigid {
 public:
  FixPlateMesh(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();
  static const Outputs<FixPlateMesh>& outputs();

 protected:
  void checkpoint(Checkpoint& state) override;
};

}  // namespace furrow::coupling
