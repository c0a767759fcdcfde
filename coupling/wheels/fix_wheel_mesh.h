// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix wheel/mesh: a rigid wheel from a mesh file. See fix_wheel_mesh.md.

#include "furrow/bodies/mesh_bodies.h"
#include "coupling/base/fix_wheel_hub.h"

namespace furrow::coupling {

class FixWheelMesh : public FixWheelHub {
 public:
  FixWheelMesh(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema() { return mesh_wheel_schema("fix wheel/mesh"); }
  static const Outputs<FixWheelMesh>& outputs();

  RigidWheel& wheel() { return static_cast<RigidWheel&>(body()); }

 protected:
  void checkpoint(Checkpoint& state) override;
};

}  // namespace furrow::coupling
