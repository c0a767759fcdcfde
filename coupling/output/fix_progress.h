// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix progress: how far a run is and how long it will take. See fix_progress.md.

#include <chrono>
#include <string>

#include "furrow/core/time_left.h"
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
  /// Work since the start of the run.
  struct Work {
    double grain_steps = 0.0, particle_updates = 0.0, tyre_steps = 0.0;
  };
  void add_work();
  double share_done() const;
  std::string rates(double elapsed) const;
  void print(double elapsed, bool last);

  double interval_;  // [s] of wall time between lines
  Clock::time_point started_;
  double printed_ = 0.0;  // [s] since the start, the last line
  TimeLeft left_;
  Work work_;
  double sub_steps_ = 0.0;  // of the bodies, of which the work is counted
};

}  // namespace furrow::coupling
