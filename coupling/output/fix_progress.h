// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix progress: how far a run is and how long it will take. See fix_progress.md.

#include <chrono>

#include "coupling/base/furrow_fix.h"

namespace furrow::coupling {

class FixProgress : public FurrowFix {
 public:
  FixProgress(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();

  int setmask() override;
  void setup(int vflag) override;
  void end_of_step() override;

 private:
  using Clock = std::chrono::steady_clock;
  void print(Clock::time_point now) const;

  double interval_;  // [s] of wall time between lines
  Clock::time_point started_;
  Clock::time_point last_;
};

}  // namespace furrow::coupling
