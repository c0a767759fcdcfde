#pragma once
/// fix wheel/history: the results folder of a wheel run. See fix_wheel_history.md.

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "coupling/dependent.h"
#include "coupling/effective_input.h"
#include "coupling/results_keeper.h"
#include "fix.h"
#include "io/history_file.h"
#include "io/vtk_file.h"

namespace furrow::coupling {

class FixWheelRig;
class FixWorld;

class FixWheelHistory : public LAMMPS_NS::Fix, public Described, public Dependent, public ResultsKeeper {
 public:
  FixWheelHistory(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();

  int setmask() override;
  void setup(int vflag) override;
  void end_of_step() override;
  void post_run() override;
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;
  const Options& options() const override { return options_; }
  void keep_results() override;
  bool needs(LAMMPS_NS::Fix& other) const override;

 private:
  void open();
  void record();
  void write_frame();
  RunClosing closing();
  FixWorld& bodies();

  Options options_;
  FixWheelRig& rig_fix_;
  std::string folder_;
  long every_, vtk_every_;
  std::optional<double> resume_time_;  // of the checkpoint that this run continues
  bool opened_ = false;

  // Rank 0 only.
  std::optional<HistoryFile> file_;
  std::optional<VtkSeries> wheel_frames_, grain_frames_;
  Grains reference_;

  std::chrono::steady_clock::time_point started_;
  long first_step_ = 0;
  double first_time_ = 0.0, first_energy_ = 0.0;
};

}  // namespace furrow::coupling
