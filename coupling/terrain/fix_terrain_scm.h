// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix terrain/scm: ground as a height field by the soil contact model. See fix_terrain_scm.md.

#include "coupling/base/roles/fix_scm.h"

namespace furrow::coupling {

class FixTerrainScm : public FixScm {
 public:
  FixTerrainScm(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();

 private:
  void refuse_overlap();
};

}  // namespace furrow::coupling
