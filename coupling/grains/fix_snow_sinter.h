// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix snow/sinter: clusters of snow that touch are bonded. See fix_snow_sinter.md.

#include "coupling/base/furrow_fix.h"

namespace furrow::coupling {

/// The contact model (model_snow_bond.cpp) does it, for as long as this fix is there.
class FixSnowSinter : public FurrowFix {
 public:
  FixSnowSinter(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema() { return Schema("fix snow/sinter"); }

  void init() override;
  /// Two grains by their place.
  bool sinters(int i, int j) const;
};

}  // namespace furrow::coupling
