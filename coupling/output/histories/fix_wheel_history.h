// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix wheel/history: the results folder of a wheel run. See fix_wheel_history.md.

#include "coupling/output/histories/fix_history.h"
#include "furrow/io/formats/vtk_file.h"
#include "furrow/rig/ground_losses.h"

namespace furrow {
class WheelHub;
}

namespace furrow::coupling {

class FixRig;

class FixWheelHistory : public FixHistory {
 public:
  FixWheelHistory(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();
  static OutputTable outputs();

  const std::string& folder() const { return options().text("folder"); }
  const WheelHub& wheel() const;
  /// "Verdict: ..." of the last run; empty before it, and on all ranks but the first.
  const std::string& verdict() const { return verdict_; }

  void post_create() override;
  void setup(int vflag) override;

 private:
  void open(std::optional<double> resume_time) override;
  void record() override;
  void write_frame() override;
  void close() override;
  RunClosing closing();
  /// Losses in everything that the wheel touches. Collective.
  GroundLosses ground_losses();

  FixRig& rig_fix_;

  // Rank 0 only.
  std::optional<VtkSeries> wheel_frames_;
  std::optional<VtkSeries> grain_frames_;
  Grains reference_;
  std::string verdict_;

  long first_step_ = 0;
  double first_time_ = 0.0;    // [s]
  double first_energy_ = 0.0;  // [J] residual of the wheel's energy
};

/// Prints the verdict on each wheel, for the end of a program: LIGGGHTS prints its statistics
/// after the summary.
void print_verdicts(LAMMPS_NS::LAMMPS& lammps);

}  // namespace furrow::coupling
