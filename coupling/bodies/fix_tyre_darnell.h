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

  DarnellTyre& tyre() { return static_cast<DarnellTyre&>(body()); }
  void init() override;
  /// f_id[1]: deflection [m], f_id[2]: inflation pressure [Pa], f_id[3]: section width [m],
  /// f_id[4]: elastic energy of the tread [J], f_id[5]: longest sidewall chord over the sidewall's
  /// length
  double compute_vector(int n) override;

 private:
  FixTyreDarnell(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, const Options& options);
};

}  // namespace furrow::coupling
