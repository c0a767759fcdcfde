#pragma once
/// fix terrain/history: the results of continuum ground. See fix_terrain_history.md.

#include <chrono>
#include <optional>
#include <string>

#include "coupling/dependent.h"
#include "coupling/effective_input.h"
#include "coupling/results_keeper.h"
#include "fix.h"
#include "io/history_file.h"
#include "io/vtk_file.h"

namespace furrow::coupling {

class FixTerrainContinuum;

class FixTerrainHistory : public LAMMPS_NS::Fix, public Described, public Dependent, public ResultsKeeper {
 public:
  FixTerrainHistory(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
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
  double time() const;

  Options options_;
  FixTerrainContinuum& ground_fix_;
  std::optional<double> resume_time_;
  bool opened_ = false;
  // Rank 0 only.
  std::optional<HistoryFile> file_;
  std::optional<VtkSeries> frames_;
  std::chrono::steady_clock::time_point started_;
};

}  // namespace furrow::coupling
