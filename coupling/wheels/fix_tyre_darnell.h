// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix tyre/darnell: an inflated tyre on a rigid rim. See fix_tyre_darnell.md.

#include "coupling/wheels/fix_tyre.h"
#include "furrow/tyre/darnell/darnell_tyre.h"

namespace furrow::coupling {

class FixTyreDarnell : public FixTyre {
 public:
  FixTyreDarnell(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();

  DarnellTyre& tyre() { return static_cast<DarnellTyre&>(body()); }

 protected:
  std::string tyre_text() override;
};

}  // namespace furrow::coupling
