// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix tyre/brick: a tyre with a tread of rubber on a carcass of shells. See fix_tyre_brick.md.

#include "coupling/wheels/fix_tyre.h"
#include "furrow/tyre/brick/brick_tyre.h"

namespace furrow::coupling {

class FixTyreBrick : public FixTyre {
 public:
  FixTyreBrick(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();

  BrickTyre& tyre() const { return static_cast<BrickTyre&>(body()); }
  void init() override;

 protected:
  std::string tyre_text() override;

 private:
  void warn_of_bridging();
};

}  // namespace furrow::coupling
